/* SPDX-License-Identifier: Apache-2.0 */
/* 7. What a maker of machines adds without changing the library: M101 opens the chuck and G200 measures a length, both functions of the host that
 * are called when the machine has done everything before; G201 calls a program; alarms have texts in the operator's language; and two arms carry
 * the tool, whose angles come out beside the positions of the axes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "nc/nc.h"

/* ---- codes ---- */

typedef struct vendor {
  bool chuck_open;
  bool door_closed;
} vendor;

static nc_status open_chuck(void* user, nc_control* nc, const nc_vendor_block* block, nc_alarm* alarm) {
  vendor* machine = user;
  (void)nc;
  if (!machine->door_closed) {
    strcpy(alarm->code, "V1"); /* a code of our own; its text stands in the table below */
    snprintf(alarm->detail.s, sizeof alarm->detail.s, "Line %u asks for the chuck.", (unsigned)block->source.line);
    return NC_E_STATE;
  }
  machine->chuck_open = true;
  printf("M101 at X %.3f: chuck open\n", block->machine.v[0]);
  return NC_OK;
}

/* G200 Hn Rr: the length of tool n is the position of Z less r. */
static nc_status measure(void* user, nc_control* nc, const nc_vendor_block* block, nc_alarm* alarm) {
  double h = 0, r = 0;
  (void)user, (void)alarm;
  for (uint32_t i = 0; i < block->word_count; ++i) {
    if (block->words[i].address == 'H') h = block->words[i].value;
    if (block->words[i].address == 'R') r = block->words[i].value;
  }
  if (h < 1) return NC_E_ARGUMENT; /* the library's own alarm NC-VENDOR names the code; nothing is to be added */
  const nc_status status = nc_tool_offset_set(nc, (unsigned)h, NC_TOOL_LENGTH, block->machine.v[2] - r);
  if (status == NC_OK) printf("G200: H%d is %.3f\n", (int)h, block->machine.v[2] - r);
  return status;
}

/* ---- texts ---- */

static bool german(void* user, const char* code, char* text, size_t size) {
  static const struct {
    const char *code, *text;
  } texts[] = {{"V1", "Spannfutter: die Tuer ist offen"}, {"P62", "Kein Vorschub programmiert"}, {"NC_E_STATE", "Das geht jetzt nicht."}};
  (void)user;
  for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
    if (strcmp(texts[i].code, code) != 0) continue;
    snprintf(text, size, "%s", texts[i].text);
    return true;
  }
  return false;
}

/* ---- joints: two arms of 300 mm and 200 mm in XY, angles in radians ---- */

static bool arms(void* user, const nc_axes* machine, nc_axes* joint) {
  const double a = 300, b = 200, x = machine->v[0], y = machine->v[1];
  const double cosine = (x * x + y * y - a * a - b * b) / (2 * a * b);
  (void)user;
  if (!(fabs(cosine) <= 1)) return false; /* out of reach */
  joint->v[1] = acos(cosine);
  joint->v[0] = atan2(y, x) - atan2(b * sin(joint->v[1]), a + b * cos(joint->v[1]));
  joint->v[2] = machine->v[2];
  return true;
}

static const char program[] =
    "G90 G01 X350. Y100. Z50. F12000\n"
    "M101\n"
    "G200 H3 R20.\n"
    "G201 X360.\n"
    "M30\n";

static const char way[] = "G01 X#24\nM99\n"; /* G201 Xx calls it: the words of the block are its arguments */

int main(void) {
  vendor machine = {.door_closed = true};
  nc_vendor_code codes[3];
  for (int i = 0; i < 3; ++i) nc_vendor_code_init(&codes[i]);
  codes[0].letter = 'M', codes[0].number = 101, codes[0].function = open_chuck, codes[0].user = &machine;
  codes[1].letter = 'G', codes[1].number = 2000, codes[1].function = measure; /* G codes times 10 */
  codes[2].letter = 'G', codes[2].number = 2010, codes[2].program = 9001, codes[2].call = NC_CALL_MACRO;

  nc_kinematics kinematics;
  nc_kinematics_init(&kinematics);
  kinematics.joint_count = 3;
  kinematics.inverse = arms;
  kinematics.joint[1].min = 0.1; /* rad: the elbow must not be stretched fully */
  kinematics.joint[1].max = 3;

  nc_config config;
  nc_config_init(&config);
  config.vendor_codes = codes;
  config.vendor_code_count = 3;
  config.alarm_text = german;
  config.kinematics[0] = &kinematics;

  /* A code that the dialect has already (M3) is refused, and the fault says why. */
  nc_config_fault fault = NC_INIT(nc_config_fault);
  codes[0].number = 3;
  if (nc_config_check(&config, &fault) == NC_OK) return 1;
  printf("refused: %s %s\n", fault.field, fault.reason);
  codes[0].number = 101;

  const size_t size = nc_memory_required(&config);
  void* memory = aligned_alloc(64, (size + 63) / 64 * 64);
  nc_status status = NC_E_MEMORY;
  nc_control* nc = memory != NULL ? nc_create(&config, memory, size, &status) : NULL;
  unsigned file = 0, sub = 0;
  nc_axes start = {{400}};
  if (nc != NULL) status = nc_position_set(nc, 0, &start);
  if (status == NC_OK) status = nc_program_add_text(nc, "O9001", way, strlen(way), &sub);
  if (status == NC_OK) status = nc_program_add_text(nc, "PART", program, strlen(program), &file);
  if (status == NC_OK) status = nc_program_select(nc, 0, file);
  if (status != NC_OK) {
    fprintf(stderr, "cannot start: %s\n", nc_status_text(status));
    return 1;
  }
  nc_inputs in;
  nc_outputs out;
  nc_inputs_init(&in);
  nc_outputs_init(&out);
  for (int run = 0; run < 2; ++run) {
    bool started = false;
    for (int cycle = 0; cycle < 20000; ++cycle) {
      nc_feed(nc, 100);
      nc_cycle(nc, &in, &out);
      in.cycle_start = cycle == 1;
      in.fin = out.strobe != 0;
      started = started || out.state == NC_STATE_RUNNING;
      if (started && (out.state == NC_STATE_IDLE || out.state == NC_STATE_ALARM)) break;
    }
    printf("X %.3f Y %.3f: arms %.4f %.4f rad\n", out.command.v[0], out.command.v[1], out.joint.v[0], out.joint.v[1]);
    nc_alarm alarm = NC_INIT(nc_alarm);
    if (nc_alarm_get(nc, 0, &alarm) == NC_OK) printf("%s: %s. %s\n", alarm.code, alarm.message, alarm.detail.s);
    machine.door_closed = false; /* for the second run, which therefore ends with alarm V1 */
  }
  double length = 0;
  nc_tool_offset_get(nc, 3, NC_TOOL_LENGTH, &length);
  char text[NC_MAX_TEXT];
  nc_status_text_get(nc, NC_E_STATE, text, sizeof text);
  printf("H3 %.3f; %s\n", length, text);
  free(memory);
  return machine.chuck_open && length == 30 && out.state == NC_STATE_ALARM ? 0 : 1;
}
