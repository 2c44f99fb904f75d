// The plate in every format the reader knows and in two old ones.
Include "plate_geometry.geo";

Mesh.Format = 1;
Mesh.Binary = 0;
Mesh.MshFileVersion = 2.2;
Save "plate-22-text.msh";
Mesh.MshFileVersion = 4.1;
Save "plate-41-text.msh";
Mesh.SaveParametric = 1;
Save "plate-41-parametric.msh";
Mesh.MshFileVersion = 2.2;
Save "plate-22-parametric.msh";
Mesh.SaveParametric = 0;
Mesh.MshFileVersion = 1.0;
Save "plate-10.msh";
Mesh.MshFileVersion = 4.0;
Save "plate-40.msh";
Mesh.Binary = 1;
Mesh.MshFileVersion = 2.2;
Save "plate-22-binary.msh";
Mesh.MshFileVersion = 4.1;
Save "plate-41-binary.msh";
Mesh.SaveParametric = 1;
Save "plate-41-binary-parametric.msh";
Mesh.SaveParametric = 0;

Mesh.MshFileVersion = 4.1;
PartitionMesh 3;
Save "plate-41-binary-partitioned.msh";
Mesh.Binary = 0;
Save "plate-41-text-partitioned.msh";
Mesh.MshFileVersion = 2.2;
Save "plate-22-text-partitioned.msh";
