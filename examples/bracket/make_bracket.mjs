// Writes bracket.nc beside this file: node make_bracket.mjs
//
// Two brackets of 60 x 50 x 15 mm side by side in one bar, the same program run in two set-ups (G54, G55): a pocket
// cleared by a sub-program with a loop, holes by canned cycles, the pocket's wall finished with the control's own
// cutter compensation. Three tools.
import {writeFileSync} from 'node:fs';

writeFileSync(new URL('bracket.nc', import.meta.url), `%
(bracket: two of 60 x 50 x 15 in a bar, each with its zero at the lower left corner of the top)
(T1 D=10 CR=0 flat end mill, 3 flutes)
(T2 D=6 CR=0 drill)
(T3 D=8 CR=1 bull nose, 4 flutes)
G21 G90 G17 G94 G40 G49 G80
(the second set-up stands 60 mm to the right)
G10 L2 P1 X0 Y0 Z0
G10 L2 P2 X60 Y0 Z0

(clears a pocket about X30 Y25, 1.1 mm left: width, height, depth, step down, half the tool)
o<pocket> sub
  #<half_x> = [#1 / 2 - #5 - 1.1]
  #<half_y> = [#2 / 2 - #5 - 1.1]
  #<z> = 0
  G0 X30 Y25
  G0 Z1
  o10 while [#<z> LT #3]
    #<z> = [#<z> + #4]
    o11 if [#<z> GT #3]
      #<z> = #3
    o11 endif
    G1 X[30 - #<half_x> / 2] Z[0 - #<z>] F300
    #<ring> = 0
    o12 repeat [4]
      #<ring> = [#<ring> + 0.25]
      #<x> = [#<half_x> * #<ring>]
      #<y> = [#<half_y> * #<ring>]
      G1 X[30 - #<x>] Y[25 - #<y>] F900
      G1 X[30 + #<x>]
      G1 Y[25 + #<y>]
      G1 X[30 - #<x>]
      G1 Y[25 - #<y>]
    o12 endrepeat
  o10 endwhile
  G0 Z10
o<pocket> endsub

(finishes the pocket's wall: width, height, depth, radius of the corners; the tool is in D)
o<wall> sub
  #<x> = [#1 / 2]
  #<y> = [#2 / 2]
  G0 X30 Y25
  G0 Z1
  G1 Z[0 - #3] F300
  G41 D3
  G1 X[30 + #<x> - 6] Y[25 - #<y> + 6] F600
  G3 X[30 + #<x>] Y[25 - #<y> + 12] I0 J6
  G1 Y[25 + #<y> - #4]
  G3 X[30 + #<x> - #4] Y[25 + #<y>] I[0 - #4] J0
  G1 X[30 - #<x> + #4]
  G3 X[30 - #<x>] Y[25 + #<y> - #4] I0 J[0 - #4]
  G1 Y[25 - #<y> + #4]
  G3 X[30 - #<x> + #4] Y[25 - #<y>] I#4 J0
  G1 X[30 + #<x> - #4]
  G3 X[30 + #<x>] Y[25 - #<y> + #4] I0 J#4
  G1 Y[25 - #<y> + 14]
  G40
  G1 X30 Y25
  G0 Z10
o<wall> endsub

T1 M6
S9000 M3
G54
o<pocket> call [36] [26] [7] [2.5] [5]
G55
o<pocket> call [36] [26] [7] [2.5] [5]

T2 M6
S4000 M3
G54
G0 X6 Y6 Z10
G98 G83 X6 Y6 Z-13 R1 Q4 F320
X54
Y44
X6
G80
G55
(rows of four, 16 mm apart)
G0 X-10 Y6 Z10
G99 G91 G81 X16 Y0 Z-14 R-9 L4 F320
G90 G80
G0 Z10
G0 X-10 Y44
G91 G81 X16 Y0 Z-14 R-9 L4
G90 G80
G0 Z10

T3 M6
S10000 M3
G54
o<wall> call [36] [26] [7] [5]
G55
o<wall> call [36] [26] [7] [5]
M5
M30
%
`);
