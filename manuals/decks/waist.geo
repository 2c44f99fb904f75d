// A bar 4 by 16 with two round notches of radius 1 in the middle; axis x = 0.
SetFactory("OpenCASCADE");
Rectangle(1) = {-2, 0, 0, 4, 16};
Disk(2) = {-2.4, 8, 0, 1};
Disk(3) = {2.4, 8, 0, 1};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2, 3}; Delete; };
Physical Surface("bar") = {4};
e = 1e-3;
Physical Curve("bottom") = Curve In BoundingBox {-2-e, -e, -e, 2+e, e, e};
Physical Curve("top") = Curve In BoundingBox {-2-e, 16-e, -e, 2+e, 16+e, e};
Mesh.MeshSizeMin = 0.9;
Mesh.MeshSizeMax = 0.9;
