// Half-open parameters: -setnumber size 0.635 for six cells per radius. Millimetres.
SetFactory("OpenCASCADE");
If (!Exists(size)) size = 0.635; EndIf
If (!Exists(radius)) radius = 3.81; EndIf
If (!Exists(height)) height = 25.4; EndIf
Cylinder(1) = {0, 0, 0, 0, 0, height, radius};
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.Algorithm3D = 1;  // Delaunay
Mesh.Optimize = 1;
Physical Volume("rod") = {1};
Physical Surface("foot") = {3};
