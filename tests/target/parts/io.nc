(waits for a part, clamps it, and tells by #510 that it has seen both)
N10 #510=0 #1100=0
WHILE [#1000 EQ 0] DO1
G4 X0.04
END1
#1100=1
#510=1
WHILE [#1000 EQ 1] DO1
G4 X0.04
END1
#1100=0
#510=2
M30
