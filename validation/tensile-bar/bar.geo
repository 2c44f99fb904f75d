// Tensile bar of the Continuum Bond Method paper (its Fig. 3), lengths in mm, x = 0 in the middle.
//
//   gmsh -2 bar.geo -o bar.msh                                 1776 particles (paper: about 1800 with l_c = 0.55)
//   gmsh -2 bar.geo -setnumber l_c 2.5 ...                     a coarse one
//   gmsh -2 bar.geo -setnumber shoulder 10 -setnumber fillet 5 another shoulder
//
// The paper gives H, Hn and Wn; the width of the shoulders and the radius of the fillets are ours (README).
// A fillet starts at the end of the straight neck, tangential to it, and ends after a quarter of a circle or at
// the side of the shoulder, whichever comes first.  Delaunay mesher, one spacing l_c.
DefineConstant[ H = 40, Hn = 18, Wn = 6, shoulder = 14, fillet = 2, l_c = 0.55 ];

reach = fillet;                                        // of the fillet across the bar
If (fillet > (shoulder - Wn) / 2)
  reach = (shoulder - Wn) / 2;
EndIf
rise = Sqrt(fillet^2 - (fillet - reach)^2);            // and along it
low = (H - Hn) / 2;
high = (H + Hn) / 2;
cut = shoulder / 2 - Wn / 2 - reach;                   // straight part between fillet and side

// the right half from the bottom to the top, then the left one back
xs() = {shoulder/2, shoulder/2, Wn/2 + reach, Wn/2, Wn/2, Wn/2 + reach, shoulder/2, shoulder/2};
ys() = {0, low - rise, low - rise, low, high, high + rise, high + rise, H};
For i In {0:7}
  Point(1 + i) = {xs(i), ys(i), 0};
  Point(16 - i) = {-xs(i), ys(i), 0};
EndFor
Point(20) = {Wn/2 + fillet, low, 0};
Point(21) = {Wn/2 + fillet, high, 0};
Point(22) = {-Wn/2 - fillet, high, 0};
Point(23) = {-Wn/2 - fillet, low, 0};

Line(1) = {16, 1};
Line(9) = {8, 9};
Line(2) = {1, 2};
If (cut > 0)
  Line(3) = {2, 3};
  Line(7) = {6, 7};
  Line(11) = {10, 11};
  Line(15) = {14, 15};
  Circle(4) = {3, 20, 4};
  Circle(6) = {5, 21, 6};
  Circle(12) = {11, 22, 12};
  Circle(14) = {13, 23, 14};
Else
  Circle(4) = {2, 20, 4};
  Circle(6) = {5, 21, 7};
  Circle(12) = {10, 22, 12};
  Circle(14) = {13, 23, 15};
EndIf
Line(5) = {4, 5};
Line(8) = {7, 8};
Line(10) = {9, 10};
Line(13) = {12, 13};
Line(16) = {15, 16};
If (cut > 0)
  Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
Else
  Curve Loop(1) = {1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 16};
EndIf
Plane Surface(1) = {1};

Physical Curve("bottom") = {1};
Physical Curve("top") = {9};
Physical Surface("bar") = {1};

Mesh.Algorithm = 5;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeMax = l_c;
