%
(steps: 90 x 40 x 12, top at Z0; 3 mm of the side, 2, 3 and 5 mm deep, climbing)
(T1 D=10 CR=0 flat end mill, 4 flutes)
G21 G90 G17 G94 G40 G49 G80
T1 M6
S6200 M3
(2 mm deep)
G0 X96 Y-2 Z5
G0 Z-2
G1 X-6 F1984
G0 Z5
(3 mm deep)
G0 X96 Y1 Z5
G0 Z-3
G1 X-6 F1984
G0 Z5
(5 mm deep)
G0 X96 Y4 Z5
G0 Z-5
G1 X-6 F1984
G0 Z5
M30
%
