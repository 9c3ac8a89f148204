// A bottle that falls on the edge of its base, in mm: a thin wall of hexahedra, drawn round its axis, which leans. A hole in the middle
// of the base spares it wedges.
//   gmsh -3 bottle.geo -o bottle.msh -setnumber size 4
DefineConstant[ size = 5 ];
wall = 1.2; lean = Pi/5;
// The wall's outside from the middle of the base up to the rim of the neck, and its inside: radii and heights.
ro[] = {8, 32, 36, 36, 34, 14, 14};  zo[] = {1, 0, 5, 100, 115, 140, 160};
ri[] = {8, 31.4, 34.8, 34.8, 32.9, 12.8, 12.8};  zi[] = {2.2, 1.2, 5.5, 99.6, 114, 139.5, 160};
For i In {0:6}
  Point(1 + i) = {ro[i], 0, zo[i]};
  Point(11 + i) = {ri[i], 0, zi[i]};
  Line(21 + i) = {1 + i, 11 + i};
  Transfinite Curve{21 + i} = 2;
EndFor
For i In {0:5}
  Line(1 + i) = {1 + i, 2 + i};
  Line(11 + i) = {11 + i, 12 + i};
  n = Ceil(Sqrt((ro[i + 1] - ro[i])^2 + (zo[i + 1] - zo[i])^2) / size) + 1;
  Transfinite Curve{1 + i, 11 + i} = n;
  Curve Loop(1 + i) = {1 + i, 22 + i, -(11 + i), -(21 + i)};
  Plane Surface(1 + i) = {1 + i};
  Transfinite Surface{1 + i};
EndFor
Recombine Surface{1:6};
Rotate{ {0, 1, 0}, {0, 0, 0}, lean } { Surface{1:6}; }
v[] = {};
s[] = {1:6};
For q In {0:3}
  For i In {0:5}
    e[] = Extrude{ {Sin(lean), 0, Cos(lean)}, {0, 0, 0}, Pi/2 } { Surface{s[i]}; Layers{Ceil(36 * Pi/2 / size)}; Recombine; };
    s[i] = e[0];
    v[] += e[1];
  EndFor
EndFor
Coherence;
Physical Volume("BOTTLE") = {v[]};
Physical Surface("SKIN") = CombinedBoundary{ Volume{v[]}; };
