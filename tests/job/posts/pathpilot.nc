(----------------------------------------)
G17 G90  (XY Plane, Absolute Distance Mode)
G64 P 0.0050 Q 0.0005 (Path Blending)
G20 (units in inches)
G54 (Set Work Offset)
G30 (Go to preset G30 location)

T  2 M6 G43 H  2
F 10.0 (Feed, minute)
S 3000 (RPM)
M3
M8
G0 X  1.0000 Y  0.5000
G0 Z  0.1000
G1 Z -0.1000
G3 X  1.0000 Y  0.5000 Z -0.2000 I -0.2500 J 0.0
G0 Z  0.5
M9 M5
G30
M30
