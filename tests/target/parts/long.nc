(to and fro until somebody stops it; each round is counted up to 15 in a variable and in a work offset that are kept over power off)
G21 G90 G94 G54
G0 X0 Y0 Z0
N10 #501=[#501+1] MOD 16
G10 L2 P2 X#501
G1 X30. F1500
Y20. Z4.
X0
Y0 Z0
GOTO 10
