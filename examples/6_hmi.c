/* SPDX-License-Identifier: Apache-2.0 */
/* 6. What an operator panel shows: the modal state of the block in execution, the blocks that come next, positions, and alarms in the
 * operator's language. The library's own texts are English; every alarm has the code of its manual, by which a table of texts finds
 * the translation. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "nc/nc.h"

static const char program[] =
    "G21 G90 G17 G94\n"
    "G54 G01 X5. F600\n"
    "G91 X5.\n"
    "G04 X.1\n"
    "G02 X10. R1.\n" /* an impossible arc: the radius is less than half of the distance to its end */
    "M30\n";

typedef struct alarm_text {
  const char *code, *text;
} alarm_text;

static const alarm_text german[] = {
    {"P33", "Formatfehler im Satz"},
    {"P70", "Kreisendpunkt stimmt nicht mit dem Radius ueberein"},
    {"P71", "Kreismittelpunkt laesst sich nicht berechnen"},
};

static const char* in_german(const nc_alarm* alarm) {
  for (size_t i = 0; i < sizeof german / sizeof *german; ++i)
    if (strcmp(german[i].code, alarm->code) == 0) return german[i].text;
  return alarm->message; /* the table has no translation: the English text */
}

/* Where line `number` of the program begins, counted from 1; the line ends at the next line break. */
static const char* line_of(const char* text, unsigned number) {
  while (number > 1 && text != NULL) {
    text = strchr(text, '\n');
    if (text != NULL) ++text;
    --number;
  }
  return text != NULL ? text : "";
}

static void show(const nc_control* nc, const nc_outputs* out) {
  nc_modal modal = NC_INIT(nc_modal);
  char codes[NC_GROUPS][8];
  unsigned count = 0;
  if (nc_modal_get(nc, 0, out->modal, &modal) == NC_OK) count = nc_modal_codes_get(nc, &modal, codes, NC_GROUPS);
  nc_axes machine = out->command, work = out->work;
  nc_position_shown(nc, 0, &machine, &work);
  const char* const now = line_of(program, out->source.line);
  const char* const next = line_of(program, out->source.line + 1);
  printf("> %.*s | next %.*s | X %.3f |", (int)strcspn(now, "\n"), now, (int)strcspn(next, "\n"), next, work.v[0]);
  for (unsigned i = 0; i < count; ++i)
    if (strcmp(codes[i], "G90") == 0 || strcmp(codes[i], "G91") == 0) printf(" %s", codes[i]);
  printf(" F%g\n", modal.feed);
}

int main(void) {
  nc_config config;
  nc_config_init(&config);
  const size_t size = nc_memory_required(&config);
  void* memory = aligned_alloc(64, (size + 63) / 64 * 64);
  nc_status status = NC_E_MEMORY;
  nc_control* nc = memory != NULL ? nc_create(&config, memory, size, &status) : NULL;
  unsigned file = 0;
  if (nc != NULL) status = nc_program_add_text(nc, "PART", program, strlen(program), &file);
  if (status == NC_OK) status = nc_program_select(nc, 0, file);
  if (status != NC_OK) {
    fprintf(stderr, "cannot start: %s\n", nc_status_text(status));
    return 1;
  }
  nc_inputs in;
  nc_outputs out;
  nc_inputs_init(&in);
  nc_outputs_init(&out);
  unsigned shown = 0;
  for (int cycle = 0; cycle < 10000 && out.state != NC_STATE_ALARM; ++cycle) {
    nc_feed(nc, 100);
    nc_cycle(nc, &in, &out);
    in.cycle_start = true;
    if (out.state == NC_STATE_RUNNING && out.source.line != shown) {
      shown = out.source.line;
      show(nc, &out);
    }
  }
  nc_alarm alarm = NC_INIT(nc_alarm);
  status = nc_alarm_get(nc, 0, &alarm);
  if (status == NC_OK) printf("%s, line %u: %s\n", alarm.code, (unsigned)alarm.source.line, in_german(&alarm));
  free(memory);
  return status == NC_OK ? 0 : 1;
}
