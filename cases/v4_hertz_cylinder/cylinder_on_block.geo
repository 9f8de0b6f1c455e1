// Half of a cylinder (radius 50, its lower part) on half of a block 200 x 200; x = 0 is the plane of symmetry, lengths in mm.
// Fine cells of `h` where they touch, coarse ones elsewhere. `rubato mesh cylinder_on_block.geo cylinder_on_block.med` wrote the .med file.
h = 0.2;
coarse = 12;
touch = 9;   // half-width of the fine part
deep = 4;    // and its height in each body
R = 50;

ys = R - Sqrt(R*R - touch*touch);

// The block: fine part, then the rest.
Point(1) = {0, 0, 0, h};
Point(2) = {touch, 0, 0, h};
Point(3) = {touch, -deep, 0, h};
Point(4) = {0, -deep, 0, h};
Point(5) = {100, 0, 0, coarse};
Point(6) = {100, -200, 0, coarse};
Point(7) = {0, -200, 0, coarse};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {2, 5};
Line(6) = {5, 6};
Line(7) = {6, 7};
Line(8) = {7, 4};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8, -3, -2};
Plane Surface(2) = {2};

// The cylinder.
Point(11) = {0, 0, 0, h};
Point(12) = {touch, ys, 0, h};
Point(13) = {touch, ys + deep, 0, h};
Point(14) = {0, deep, 0, h};
Point(15) = {R, R, 0, coarse};
Point(16) = {0, R, 0, coarse};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};
Circle(11) = {11, 16, 12};
Circle(15) = {12, 16, 15};
Line(16) = {15, 16};
Line(17) = {16, 14};
Curve Loop(11) = {11, 12, 13, 14};
Plane Surface(11) = {11};
Curve Loop(12) = {15, 16, 17, -13, -12};
Plane Surface(12) = {12};

n = Round(touch / h);
m = Round(deep / h / 2);
Transfinite Curve {1, 11} = n + 1;
Transfinite Curve {-3, -13} = n + 1;
Transfinite Curve {-4, 2, -14, 12} = m + 1 Using Progression 1.08;
Transfinite Surface {1, 11};
Recombine Surface {1, 2, 11, 12};
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 1;

Physical Surface("block") = {1, 2};
Physical Surface("cylinder") = {11, 12};
Physical Curve("block_face") = {1};
Physical Curve("cylinder_face") = {11};
Physical Curve("symmetry") = {4, 8, 14, 17};
Physical Curve("ground") = {7};
Physical Curve("middle") = {16};
