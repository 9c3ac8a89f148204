// A bracket of aluminium with a hole, tilted, in mm. gmsh -3 bracket.geo -o bracket.msh
SetFactory("OpenCASCADE");
DefineConstant[ size = 6 ];          // of the cells

Box(1) = {0, 0, 0, 60, 40, 6};                          // the foot
Box(2) = {0, 0, 0, 6, 40, 50};                          // the back
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {40, 20, -1, 0, 0, 8, 8};
BooleanDifference(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
Rotate{ {0, 1, 0}, {0, 0, 0}, Pi/6 } { Volume{5}; }     // so that it falls on the end of its foot
box() = BoundingBox Volume{5};
Translate{ 0, 0, 0.1 - box(2) } { Volume{5}; }          // 0.1 mm above the floor, z = 0

Physical Volume("BRACKET") = {5};
Physical Surface("SKIN") = Boundary{ Volume{5}; };
Mesh.MeshSizeMax = size;
Mesh.ElementOrder = 2;
Mesh.SecondOrderLinear = 1;                             // straight sides
