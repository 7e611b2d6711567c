(a slot with round ends, a helix out of it and a diagonal: lines, arcs and all three axes, with rests between them)
G21 G90 G94 G17 G54
G4 X1.
G0 X0 Y0
Z5.
G1 Z-1. F1200
X20. F2400
G3 X20. Y10. J5.
G1 X0
G3 X0 Y0 J-5.
G4 X1.
G3 X10. Y10. Z2. I0 J10. F1800
G1 X5. Y4. Z5.
X6. Y9.
X8. Y3.5
G4 X1.
G0 X-3. Y12.
M8
G1 X2.5 Y-2.5 Z0.125 F900
G4 X1.
M30
