// Half section of a sphere of radius 10 that touches y = 0 at the axis x = 0, lengths in mm.
// Fine cells of `h` where it hits. `rubato mesh sphere.geo sphere.med` wrote the .med file.
h = 0.025;
coarse = 1;
touch = 0.6;
deep = 0.5;
R = 10;

ys = R - Sqrt(R*R - touch*touch);
Point(1) = {0, 0, 0, h};
Point(2) = {touch, ys, 0, h};
Point(3) = {touch, ys + deep, 0, h};
Point(4) = {0, deep, 0, h};
Point(5) = {R, R, 0, coarse};
Point(6) = {0, 2*R, 0, coarse};
Point(7) = {0, R, 0, coarse};
Circle(1) = {1, 7, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Circle(5) = {2, 7, 5};
Circle(6) = {5, 7, 6};
Line(7) = {6, 7};
Line(8) = {7, 4};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8, -3, -2};
Plane Surface(2) = {2};
n = Round(touch / h);
m = Round(deep / h * 0.7);
Transfinite Curve {1, -3} = n + 1;
Transfinite Curve {-4, 2} = m + 1 Using Progression 1.05;
Transfinite Surface {1};
Recombine Surface {1, 2};
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 1;

Physical Surface("sphere") = {1, 2};
Physical Curve("pole") = {1};
Physical Curve("axis") = {4, 7, 8};
Physical Point("lowest") = {1};
Physical Point("centre") = {7};
Physical Point("highest") = {6};
