(a skip move that a contact ends; #531 and #532 get its skip position, then #530 is 1)
G21 G90 G94 G54
#530=2
G0 X0 Y0 Z0
#530=0
G31 X60. Y30. F900
#531=#5061
#532=#5062
#530=1
M30
