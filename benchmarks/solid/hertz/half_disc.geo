// A quarter of a disc, quadrilaterals of size h/2 where it touches the ground: gmsh -2 -format msh22 -setnumber h 0.002 -o half_disc_2.msh half_disc.geo
DefineConstant[ h = 0.0005 ];
SetFactory("Built-in");
Point(1) = {0, 0, 0, 0.02}; Point(2) = {0, -0.1, 0, h}; Point(3) = {0.1, 0, 0, 0.02}; Point(4) = {0, -0.01, 0, 0.01};
Line(1) = {1, 4}; Line(2) = {4, 2}; Circle(3) = {2, 1, 3}; Line(4) = {3, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1}; Recombine Surface {1};
Field[1] = Distance; Field[1].PointsList = {2};
Field[2] = Threshold; Field[2].InField = 1; Field[2].SizeMin = h; Field[2].SizeMax = 0.02; Field[2].DistMin = 0.008; Field[2].DistMax = 0.1;
Background Field = 2; Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;
Mesh.SubdivisionAlgorithm = 1; Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
Physical Surface("disc") = {1}; Physical Curve("round") = {3}; Physical Curve("axis") = {2}; Physical Curve("top") = {4};
