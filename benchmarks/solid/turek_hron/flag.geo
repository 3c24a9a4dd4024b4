// The flag of Turek and Hron behind its cylinder, 17.5 n × n quadrilaterals with nodes on their edges (the root lies on
// the cylinder): gmsh -2 -order 2 -format msh22 -setnumber n 2 -o flag_2.msh flag.geo
DefineConstant[ n = 2 ];
SetFactory("Built-in"); Mesh.SecondOrderIncomplete = 1;
Point(1) = {0.2 + Sqrt(0.05^2 - 0.01^2), 0.19, 0}; Point(2) = {0.6, 0.19, 0}; Point(3) = {0.6, 0.21, 0};
Point(4) = {0.2 + Sqrt(0.05^2 - 0.01^2), 0.21, 0}; Point(5) = {0.2, 0.2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Circle(4) = {4, 5, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 17.5 * n + 1; Transfinite Curve {2, 4} = n + 1; Transfinite Surface {1}; Recombine Surface {1};
Physical Surface("flag") = {1}; Physical Curve("root") = {4};
