// A quarter of a ball, tetrahedra of size h where it will touch the ground: gmsh -3 -format msh22 -setnumber h 0.002 -o quarter_2.msh quarter.geo
DefineConstant[ h = 0.002 ];
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0.05, 0.05}; Box(2) = {0, 0, -1, 1, 1, 2};
BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
low() = Point In BoundingBox{-0.001, -0.001, -0.001, 0.001, 0.001, 0.001};
Field[1] = Distance; Field[1].PointsList = {low()};
Field[2] = Threshold; Field[2].InField = 1; Field[2].SizeMin = h; Field[2].SizeMax = 0.02; Field[2].DistMin = 0.008; Field[2].DistMax = 0.05;
Background Field = 2; Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.ElementOrder = 2;
x() = Surface In BoundingBox{-0.001, -0.001, -0.001, 0.001, 0.201, 0.201};
y() = Surface In BoundingBox{-0.001, -0.001, -0.001, 0.201, 0.001, 0.201};
all() = Boundary { Volume{3}; };
Physical Volume("ball") = {3}; Physical Surface("x") = {x()}; Physical Surface("y") = {y()};
round() = all(); round() -= x(); round() -= y();
Physical Surface("round") = {round()};
