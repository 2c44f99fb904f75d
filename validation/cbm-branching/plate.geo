// Plate with a band of fine particles around its middle, for the fracture cases of the Continuum Bond Method
// paper (its Fig. 11).  Lengths in mm.  Spacing l_ref inside the strip, growing linearly to l_edge at the
// bottom and top edges; Delaunay mesher.  The pre-crack is not meshed: the deck cuts it.
//
//   gmsh -2 plate.geo -o plate.msh                         branching plate, 14 342 particles (paper: 14 431)
//   gmsh -2 plate.geo -setnumber l_ref 0.25 ...            a coarser one
//
// factor scales all target sizes a little, which rearranges the particles: 0.997 gives the "second mesh".
DefineConstant[ W = 30, H = 20, strip = 8, l_edge = 1, l_ref = 1/6, factor = 1 ];

Point(1) = {0, 0, 0};
Point(2) = {W, 0, 0};
Point(3) = {W, H, 0};
Point(4) = {0, H, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("plate") = {1};

// l_ref + slope * max(0, |y - H/2| - strip/2)
slope = (l_edge - l_ref) / ((H - strip) / 2);
Field[1] = MathEval;
Field[1].F = Sprintf("%.17g + %.17g * (abs(y - %.17g) - %.17g + abs(abs(y - %.17g) - %.17g)) / 2",
                     l_ref, slope, H/2, strip/2, H/2, strip/2);
Background Field = 1;

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm = 5;
Mesh.MeshSizeFactor = factor;
