// Plate of Kalthoff and Winkler in two dimensions for the Continuum Bond Method: 100 x 200 mm, two slots of 50 x 1.125 mm whose
// middles are 50 mm apart.  Size h everywhere, Delaunay mesher: no direction for a crack to follow.
//
//   gmsh -2 plate.geo -o plate.msh                    13 222 particles
//   gmsh -2 plate.geo -setnumber h 0.75 -o plate.msh  52 052 particles
DefineConstant[ h = 1.5, slot = 1.125 ];

Point(1) = {0, 0, 0, h};
Point(2) = {100, 0, 0, h};
Point(3) = {100, 200, 0, h};
Point(4) = {0, 200, 0, h};
Point(5) = {0, 125 + slot/2, 0, h};
Point(6) = {50, 125 + slot/2, 0, h};
Point(7) = {50, 125 - slot/2, 0, h};
Point(8) = {0, 125 - slot/2, 0, h};
Point(9) = {0, 75 + slot/2, 0, h};
Point(10) = {50, 75 + slot/2, 0, h};
Point(11) = {50, 75 - slot/2, 0, h};
Point(12) = {0, 75 - slot/2, 0, h};
For corner In {1:11}
  Line(corner) = {corner, corner + 1};
EndFor
Line(12) = {12, 1};
Curve Loop(1) = {1:12};
Plane Surface(1) = {1};
Physical Surface("plate") = {1};
Mesh.Algorithm = 5;
