// The mesh of plate_with_hole.toml:  gmsh -2 -order 2 -format msh41 plate_with_hole.geo
// A square plate of side 8 with a hole of radius 1, in two parts that meet on a circle of radius 2.
SetFactory("Built-in");
fine = 0.07;
coarse = 1.0;
Point(1) = {0, 0, 0, fine};
For k In {0 : 3}
  Point(2 + k) = {Cos(k * Pi / 2), Sin(k * Pi / 2), 0, fine};
  Point(6 + k) = {2 * Cos(k * Pi / 2), 2 * Sin(k * Pi / 2), 0, 3 * fine};
EndFor
Point(10) = {-4, -4, 0, coarse};
Point(11) = {4, -4, 0, coarse};
Point(12) = {4, 4, 0, coarse};
Point(13) = {-4, 4, 0, coarse};
For k In {0 : 3}
  Circle(1 + k) = {2 + k, 1, 2 + (k + 1) % 4};
  Circle(5 + k) = {6 + k, 1, 6 + (k + 1) % 4};
  Line(9 + k) = {10 + k, 10 + (k + 1) % 4};
EndFor
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6, 7, 8};
Curve Loop(3) = {9, 10, 11, 12};
Plane Surface(1) = {2, 1};
Plane Surface(2) = {3, 2};
Physical Surface("ring") = {1};
Physical Surface("plate") = {2};
