// Plate of 82.5 mm with the 31 holes of holes.geo for the finite elements of fem.nml, small elements at the holes.
//
//   gmsh -2 plate.geo -o plate.msh
DefineConstant[ plate = 7, height = 82.5, h = 0.3, far = 2 ];
Include "holes.geo";

Point(1) = {0, 0, 0, far};
Point(2) = {82.5, 0, 0, far};
Point(3) = {82.5, height, 0, far};
Point(4) = {0, height, 0, far};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Curve Loop(1) = {1:4};
loops() = {1};
For n In {1 : #hole() / 3}
  x = hole(3 * n - 3);
  y = hole(3 * n - 2);
  r = hole(3 * n - 1);
  p = newp;
  Point(p) = {x, y, 0, h};
  Point(p + 1) = {x + r, y, 0, h};
  Point(p + 2) = {x, y + r, 0, h};
  Point(p + 3) = {x - r, y, 0, h};
  Point(p + 4) = {x, y - r, 0, h};
  For i In {0:3}
    Circle(4 * n + 1 + i) = {p + 1 + i, p, p + 1 + (i + 1) % 4};
  EndFor
  Curve Loop(1 + n) = {4 * n + 1 : 4 * n + 4};
  loops() += {1 + n};
EndFor
Plane Surface(1) = {loops()};
Physical Surface("plate") = {1};
Mesh.Algorithm = 5;
