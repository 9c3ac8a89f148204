// A crash box: a square tube of sheet steel, in mm; hexahedra, one through the sheet.
//   gmsh -3 crash_box.geo -o crash_box.msh -setnumber size 5
DefineConstant[ size = 8.5 ];
width = 60; height = 120; sheet = 3;
n = Ceil(width / size);
// Corners of its outside and of its inside.
For k In {0:1}
  a = width/2 - k*sheet;
  Point(1 + 4*k) = {-a, -a, 0}; Point(2 + 4*k) = {a, -a, 0}; Point(3 + 4*k) = {a, a, 0}; Point(4 + 4*k) = {-a, a, 0};
EndFor
For i In {0:3}
  Line(1 + i) = {1 + i, 1 + (i + 1) % 4};
  Line(5 + i) = {5 + i, 5 + (i + 1) % 4};
  Line(9 + i) = {1 + i, 5 + i};
  Transfinite Curve{1 + i, 5 + i} = n + 1;
  Transfinite Curve{9 + i} = 2;
EndFor
For i In {0:3}
  Curve Loop(1 + i) = {1 + i, 9 + (i + 1) % 4, -(5 + i), -(9 + i)};
  Plane Surface(1 + i) = {1 + i};
  Transfinite Surface{1 + i};
EndFor
Recombine Surface{1:4};
Extrude{0, 0, height} { Surface{1:4}; Layers{Ceil(height / size)}; Recombine; }
Physical Volume("TUBE") = {1:4};
Physical Surface("SKIN") = CombinedBoundary{ Volume{1:4}; };
Physical Surface("FOOT") = {1:4};
