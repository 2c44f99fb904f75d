// The plate with elements that are skipped (quadrangles) or refused (second order).
Include "plate_geometry.geo";

Mesh.Format = 1;
Mesh.Binary = 1;
RecombineMesh;
Mesh.MshFileVersion = 2.2;
Save "plate-22-quadrangles.msh";
Mesh.MshFileVersion = 4.1;
Save "plate-41-quadrangles.msh";
SetOrder 2;
Save "plate-41-second-order.msh";
Mesh.Binary = 0;
Mesh.MshFileVersion = 2.2;
Save "plate-22-second-order.msh";
