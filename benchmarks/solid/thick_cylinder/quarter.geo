// A quarter of a thick cylinder, n × 2n quadrilaterals: gmsh -2 -format msh22 -setnumber n 4 -o quarter_4.msh quarter.geo
DefineConstant[ n = 4 ];
SetFactory("Built-in");
Point(1) = {0, 0, 0}; Point(2) = {0.1, 0, 0}; Point(3) = {0.2, 0, 0}; Point(4) = {0, 0.2, 0}; Point(5) = {0, 0.1, 0};
Line(1) = {2, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 5}; Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = n + 1; Transfinite Curve {2, 4} = 2 * n + 1; Transfinite Surface {1}; Recombine Surface {1};
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
Physical Surface("rubber") = {1}; Physical Curve("inner") = {4}; Physical Curve("bottom") = {1}; Physical Curve("left") = {3};
