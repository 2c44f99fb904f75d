// Strip (depth = 0) or bar of width x length (x depth) mm for the plane waves; irregular Delaunay mesh of spacing h.
//   gmsh -2 bar.geo -o bar.msh                    gmsh -3 bar.geo -setnumber depth 4 -o bar.msh
DefineConstant[ width = 4, length = 40, depth = 0, h = 1 ];

SetFactory("OpenCASCADE");
If (depth > 0)
  Box(1) = {0, 0, 0, width, length, depth};
  Physical Volume("bar") = {1};
Else
  Rectangle(1) = {0, 0, 0, width, length};
  Physical Surface("bar") = {1};
EndIf

Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.Algorithm = 5;
Mesh.Algorithm3D = 1;
