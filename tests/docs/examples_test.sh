#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every numbered example runs to its end and prints what docs/embedding.md says about it.
set -euo pipefail
status=0
# shows NAME LINE...: the example ends with status 0 and has printed these whole lines in this order.
shows() {
  local name=$1 out line at=0 found
  shift
  if ! out=$("$NC_BINARY_DIR/bin/example_$name"); then echo "FAILED: $name did not end well:"; echo "$out"; status=1; return; fi
  for line in "$@"; do
    found=$(tail -n +$((at + 1)) <<<"$out" | grep -nxF -- "$line" | head -n 1 | cut -d: -f1 || true)
    if [ -z "$found" ]; then echo "FAILED: $name has not printed '$line' but:"; echo "$out"; status=1; return; fi
    at=$((at + found))
  done
  grep -q "examples/$name.c" "$NC_SOURCE_DIR/docs/embedding.md" || { echo "FAILED: docs/embedding.md says nothing of $name"; status=1; }
}
# The arc is a quarter of 10 mm radius, 15.708 mm; X 25 is the answer of the machine, 20, and 5.
shows 1_trace 'line 2: rapid to X 10.000 Y 0.000, 10.000 mm' 'line 3: line  to X 10.000 Y 20.000, 20.000 mm' \
  'line 4: arc   to X 20.000 Y 30.000, 15.708 mm' 'line 6: line  to X 25.000 Y 30.000, 5.000 mm' '50.708 mm. The program has ended.'
# 41.231 + 1 + 62.832 + 41.231 mm; a drive that goes half of its distance in each cycle lags by the way of one cycle: 0.25 mm at 250 mm/s.
shows 2_drive 'X 0.000 Y 0.000 Z -1.000 after 146.294 mm of path; the drives were up to 0.25 mm behind'
shows 3_override 'started      running  feed 6000 mm/min, override 100 %' 'override     running  feed 3000 mm/min, override  50 %' \
  'feed hold    hold     feed    0 mm/min, override  50 %, waits for the end of feed hold' \
  'cycle start  running  feed 6000 mm/min, override 100 %' 'end          idle     feed    0 mm/min, override 100 %' 'X 100.000'
# 6394 lines with X, each twice.
shows 4_windows '12788 moves, 2 dwells of a sub program that was added 1 time(s)' \
  '512 bytes or fewer at once, the text is read again' 'The program has ended.'
shows 5_retain 'after power on: #501 = 12.5, G54 X = 100'
shows 6_hmi '> G54 G01 X5. F600 | next G91 X5. | X 0.010 | G90 F0' '> G91 X5. | next G04 X.1 | X 5.010 | G90 F600' \
  '> G04 X.1 | next G02 X10. R1. | X 10.000 | G91 F600' 'P71, line 5: Kreismittelpunkt laesst sich nicht berechnen'
# The length is 50, where Z stands, less R 20, that is, 30. In the second run the door is open, and the program stops where it asks for the chuck.
shows 7_vendor 'refused: vendor_codes[0].number is a code of the dialect; override_dialect takes its place' 'M101 at X 350.000: chuck open' \
  'G200: H3 is 30.000' 'X 360.000 Y 100.000: arms -0.2919 1.4907 rad' 'X 350.000 Y 100.000: arms -0.3033 1.5500 rad' \
  'V1: Spannfutter: die Tuer ist offen. Line 2 asks for the chuck.' 'H3 30.000; Das geht jetzt nicht.'
for source in "$NC_SOURCE_DIR"/examples/[0-9]*.c; do
  name=$(basename "$source" .c)
  grep -q "^shows $name " "$0" || { echo "FAILED: nobody looks at what $name prints"; status=1; }
done
exit $status
