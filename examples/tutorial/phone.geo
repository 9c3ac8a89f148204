// A phone that falls on its corner, in mm: a case of aluminium with a frame, a battery, and a glass on a foam.
// Its outline is meshed by quadrangles and drawn out in layers, so that all cells are hexahedra (and a few wedges).
//   gmsh -3 phone.geo -o phone.msh -setnumber size 3
DefineConstant[ size = 4 ];          // of the cells along the plates
length = 140; width = 70; radius = 10; frame = 2.5;
back = 1; middle = 5; foam = 0.4; glass = 0.8;
roll = Pi/4; pitch = Pi/3;                  // 0, 0: it falls flat on its back

// Rounded rectangles in z = 0, d inside of the outline.
Macro Outline
  p = newp; l = newl; r = radius - d;
  xs[] = {radius, length - radius, length - radius, radius};
  ys[] = {radius, radius, width - radius, width - radius};
  For i In {0:3}
    a = (i - 2) * Pi/2;                     // where the arc of this corner begins
    Point(p + 3*i) = {xs[i], ys[i], 0, size};
    Point(p + 3*i + 1) = {xs[i] + r*Cos(a), ys[i] + r*Sin(a), 0, size};
    Point(p + 3*i + 2) = {xs[i] + r*Cos(a + Pi/2), ys[i] + r*Sin(a + Pi/2), 0, size};
  EndFor
  For i In {0:3}
    Circle(l + 2*i) = {p + 3*i + 1, p + 3*i, p + 3*i + 2};
    Line(l + 2*i + 1) = {p + 3*i + 2, p + 3*((i + 1) % 4) + 1};
    Transfinite Curve{l + 2*i} = 1 + Ceil(radius*Pi/2 / size);
  EndFor
  loop = newll;
  Curve Loop(loop) = {l:l + 7};
Return

d = 0;
Call Outline;
outer = loop;
d = frame;
Call Outline;
inner = loop;

p = newp; l = newl;                         // the battery's place
Point(p) = {40, 12, 0, size}; Point(p + 1) = {115, 12, 0, size};
Point(p + 2) = {115, 58, 0, size}; Point(p + 3) = {40, 58, 0, size};
For i In {0:3}
  Line(l + i) = {p + i, p + (i + 1) % 4};
EndFor
battery = newll;
Curve Loop(battery) = {l:l + 3};

Plane Surface(1) = {outer, inner};
Plane Surface(2) = {inner, battery};
Plane Surface(3) = {battery};
Recombine Surface{1, 2, 3};

Rotate{ {1, 0, 0}, {0, 0, 0}, roll } { Surface{1, 2, 3}; }
Rotate{ {0, 1, 0}, {0, 0, 0}, -pitch } { Surface{1, 2, 3}; }
ux = Sin(pitch); uy = Sin(roll)*Cos(pitch);              // how far a step along the phone leads up
low = radius * (ux + uy - Sqrt(ux^2 + uy^2));            // the lowest place of the rounded corner
Translate{ 0, 0, 0.1 - low } { Surface{1, 2, 3}; }       // 0.1 mm above the floor, z = 0
nx = -Sin(pitch)*Cos(roll); ny = -Sin(roll); nz = Cos(pitch)*Cos(roll);   // where the glass looks

// Everything is drawn out through every layer; what has no group, the empty space around the battery, is not written.
s[] = {1, 2, 3};                            // frame, space, battery
h[] = {back, middle, foam, glass};
layers[] = {1, 3, 1, 1};
v[] = {};
For k In {0:3}
  For i In {0:2}
    e[] = Extrude{nx*h[k], ny*h[k], nz*h[k]} { Surface{s[i]}; Layers{layers[k]}; Recombine; };
    s[i] = e[0];
    v[] += e[1];
  EndFor
EndFor

Physical Volume("CASE") = {v[0], v[1], v[2], v[3]};
Physical Volume("BATTERY") = {v[5]};
Physical Volume("FOAM") = {v[6]};
Physical Volume("GLASS") = {v[9], v[10], v[11]};
Physical Surface("SKIN") = CombinedBoundary{ Volume{v[0], v[1], v[2], v[3], v[5], v[6], v[9], v[10], v[11]}; };
