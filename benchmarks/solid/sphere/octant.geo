// An eighth of a thick sphere, tetrahedra of size h: gmsh -3 -format msh22 -setnumber h 0.05 -o octant_2.msh octant.geo
DefineConstant[ h = 0.05 ];
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 0.2}; Sphere(2) = {0, 0, 0, 0.1}; Box(3) = {0, 0, 0, 1, 1, 1};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanIntersection(5) = { Volume{4}; Delete; }{ Volume{3}; Delete; };
Mesh.MeshSizeMin = h; Mesh.MeshSizeMax = h; Mesh.ElementOrder = 2;
inner() = Surface In BoundingBox{-0.001, -0.001, -0.001, 0.101, 0.101, 0.101};
x() = Surface In BoundingBox{-0.001, -0.001, -0.001, 0.001, 0.201, 0.201};
y() = Surface In BoundingBox{-0.001, -0.001, -0.001, 0.201, 0.001, 0.201};
z() = Surface In BoundingBox{-0.001, -0.001, -0.001, 0.201, 0.201, 0.001};
Physical Volume("rubber") = {5}; Physical Surface("inner") = {inner()};
Physical Surface("x") = {x()}; Physical Surface("y") = {y()}; Physical Surface("z") = {z()};
