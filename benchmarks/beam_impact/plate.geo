// The right half of the wedge: 40 x 4 eight-node quadrilaterals. gmsh -2 plate.geo
// Keel at the origin, deadrise 10 degrees, 0.6 m wide horizontally, 0.04 m thick.
b = 10 * Pi / 180;
L = 0.6 / Cos(b);
e = 0.04;
Point(1) = {0, 0, 0};
Point(2) = {L * Cos(b), L * Sin(b), 0};
Point(3) = {L * Cos(b) - e * Sin(b), L * Sin(b) + e * Cos(b), 0};
Point(4) = {-e * Sin(b), e * Cos(b), 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 41;
Transfinite Curve {2, 4} = 5;
Transfinite Surface {1};
Recombine Surface {1};
Physical Curve("wet") = {1};
Physical Curve("chine") = {2};
Physical Curve("top") = {3};
Physical Curve("keel") = {4};
Physical Surface("plate") = {1};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.MshFileVersion = 4.1;
