// The leaf of a hinge: an eye for the pin, and a plate, in mm; hexahedra.
//   gmsh -3 hinge.geo -o hinge.msh -setnumber size 2
DefineConstant[ size = 2.5 ];
inner = 5.05; outer = 10; long = 60; thick = 6; wide = 24;
c = Asin(thick/2 / outer);                   // where the plate leaves the eye
angles[] = {c, Pi/2, Pi, 3*Pi/2, 2*Pi - c};
Point(100) = {0, 0, 0};
For i In {0:4}
  Point(1 + i) = {inner*Cos(angles[i]), 0, inner*Sin(angles[i])};
  Point(11 + i) = {outer*Cos(angles[i]), 0, outer*Sin(angles[i])};
  Line(21 + i) = {1 + i, 11 + i};
  Transfinite Curve{21 + i} = Ceil((outer - inner) / size) + 1;
EndFor
For i In {0:4}
  j = (i + 1) % 5;
  Circle(1 + i) = {1 + i, 100, 1 + j};
  If (i < 4)
    Circle(11 + i) = {11 + i, 100, 11 + j};
    n = Ceil(outer*(angles[j] - angles[i]) / size) + 1;
  Else
    Line(15) = {15, 11};
    n = Ceil(thick / size) + 1;
  EndIf
  Transfinite Curve{1 + i, 11 + i} = n;
  Curve Loop(1 + i) = {1 + i, 21 + j, -(11 + i), -(21 + i)};
  Plane Surface(1 + i) = {1 + i};
  Transfinite Surface{1 + i};
EndFor
Point(31) = {long, 0, -thick/2}; Point(32) = {long, 0, thick/2};
Line(31) = {15, 31}; Line(32) = {31, 32}; Line(33) = {32, 11};
Transfinite Curve{32} = Ceil(thick / size) + 1;
Transfinite Curve{31, 33} = Ceil(long / size) + 1;
Curve Loop(6) = {31, 32, 33, -15};
Plane Surface(6) = {6};
Transfinite Surface{6} = {15, 31, 32, 11};
Recombine Surface{1:6};
Extrude{0, wide, 0} { Surface{1:6}; Layers{Ceil(wide / size / 2)}; Recombine; }
Physical Volume("LEAF") = {1:6};
Physical Surface("SKIN") = CombinedBoundary{ Volume{1:6}; };
