// Two plates that share an edge, with an inner crack line: everything that groups can be. Used by
// plate.geo and plate_refused.geo.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1};
Rectangle(2) = {2, 0, 0, 1, 1};
Point(20) = {0.5, 0.5, 0};
Point(21) = {1.5, 0.5, 0};
Line(20) = {20, 21};
BooleanFragments{ Surface{1, 2}; Delete; }{ Curve{20}; Delete; }
MeshSize{ : } = 0.3;
Physical Surface("plate") = Surface{:};
Physical Surface("right", 9) = Surface In BoundingBox{1.9, -0.1, -0.1, 3.1, 1.1, 0.1};
Physical Curve("left side") = -Curve In BoundingBox{-0.1, -0.1, -0.1, 0.1, 1.1, 0.1};
Physical Curve("crack") = Curve In BoundingBox{0.4, 0.4, -0.1, 1.6, 0.6, 0.1};
Physical Curve(7) = Curve In BoundingBox{2.9, -0.1, -0.1, 3.1, 1.1, 0.1};
Physical Point("corner") = Point In BoundingBox{-0.1, -0.1, -0.1, 0.1, 0.1, 0.1};
Physical Point("nowhere", 99) = {};
Mesh 2;
