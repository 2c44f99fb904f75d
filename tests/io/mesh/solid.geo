// A block with a periodic pair of faces; meshed once, saved in the four formats.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2, 1, 1};
Periodic Surface{2} = {1} Translate{2, 0, 0};
MeshSize{ : } = 0.5;
Physical Volume("block") = {1};
Physical Surface("left") = {1};
Physical Surface("outside") = Surface{:};
Physical Curve("edge") = {1};
Physical Point("corner") = {1};
Mesh 3;

Mesh.Format = 1;
Mesh.Binary = 0;
Mesh.MshFileVersion = 2.2;
Save "solid-22-text.msh";
Mesh.MshFileVersion = 4.1;
Save "solid-41-text.msh";
Mesh.Binary = 1;
Save "solid-41-binary.msh";
Mesh.MshFileVersion = 2.2;
Save "solid-22-binary.msh";
