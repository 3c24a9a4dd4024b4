# Reads frames as ParaView does and prints what it finds; run by tests/io/vtk_hdf.cpp where ParaView is installed.
import sys
from paraview.simple import OpenDataFile
from paraview import servermanager


def describe(grid):
    print("points", grid.GetNumberOfPoints(), "cells", grid.GetNumberOfCells(), "type", grid.GetCellType(0))
    x, y, z = grid.GetPoint(grid.GetNumberOfPoints() - 1)
    print("last point", x, y, z)
    for name, data in (("point", grid.GetPointData()), ("cell", grid.GetCellData())):
        for i in range(data.GetNumberOfArrays()):
            array = data.GetArray(i)
            last = array.GetTuple(array.GetNumberOfTuples() - 1)
            print(name, array.GetName(), array.GetNumberOfComponents(), array.GetDataTypeAsString(), *last)


reader = OpenDataFile(sys.argv[1])
reader.UpdatePipeline()
print("times", *getattr(reader, "TimestepValues", []))
describe(servermanager.Fetch(reader))
