// A wheel with 24 spokes and cavities between them, n quadrilaterals along each of 96 sectors:
// gmsh -2 -format msh22 -setnumber n 1 -o wheel_1.msh wheel.geo
DefineConstant[ n = 1 ];
SetFactory("Built-in");
sectors = 96; r[] = {0.15, 0.2, 0.25, 0.3};
Point(1) = {0, 0, 0};
For i In {0 : sectors - 1}
  For k In {0 : 3}
    Point(10 + 4 * i + k) = {r[k] * Cos(2 * Pi * i / sectors), r[k] * Sin(2 * Pi * i / sectors), 0};
  EndFor
EndFor
arc = 1000; ray = 3000; area = 5000;
For i In {0 : sectors - 1}
  next = (i + 1) % sectors;
  For k In {0 : 3}
    Circle(arc + 4 * i + k) = {10 + 4 * i + k, 1, 10 + 4 * next + k};
  EndFor
  For k In {0 : 2}
    Line(ray + 4 * i + k) = {10 + 4 * i + k, 10 + 4 * i + k + 1};
  EndFor
EndFor
inner[] = {}; outer[] = {}; cavities[] = {}; rubber[] = {};
For i In {0 : sectors - 1}
  next = (i + 1) % sectors; spoke = (i % 4 == 0);
  For k In {0 : 2}
    If (k != 1 || spoke)
      Curve Loop(area + 4 * i + k) = {ray + 4 * i + k, arc + 4 * i + k + 1, -(ray + 4 * next + k), -(arc + 4 * i + k)};
      Plane Surface(area + 4 * i + k) = {area + 4 * i + k}; rubber[] += area + 4 * i + k;
    EndIf
  EndFor
  inner[] += arc + 4 * i; outer[] += arc + 4 * i + 3;
  If (!spoke)
    cavities[] += {arc + 4 * i + 1, arc + 4 * i + 2};
  EndIf
  If (i % 4 == 0 || i % 4 == 1)
    cavities[] += ray + 4 * i + 1;
  EndIf
EndFor
Transfinite Curve "*" = n + 1; Transfinite Surface "*"; Recombine Surface "*";
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
Physical Surface("rubber") = {rubber[]}; Physical Curve("inner") = {inner[]}; Physical Curve("outer") = {outer[]};
Physical Curve("cavities") = {cavities[]};
