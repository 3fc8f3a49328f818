%
(slot: 240 x 20 x 10, top of stock at Z0, 1 mm deep along the middle)
(speed and feed are those of the job)
G21 G90 G17 G94 G40 G49 G80
M3
G0 X-7 Y10 Z5
G0 Z-1
G1 X247
G0 Z5
M30
%
