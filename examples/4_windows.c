/* SPDX-License-Identifier: Apache-2.0 */
/* 4. Programs from flash: a program of 100 kB is read through a window of 512 bytes, and again where it jumps back. A sub program that is
 * not in the store is added at the moment at which it is called. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "nc/nc.h"

enum { kLine = 16, kLines = 6400 };

/* A stand-in for a memory that is read in pieces: each line is made when it is asked for. */
static void line_of_flash(unsigned line, char text[kLine + 1]) {
  if (line == 0) snprintf(text, kLine + 1, "%-*s\n", kLine - 1, "#1=0");
  else if (line == 1) snprintf(text, kLine + 1, "%-*s\n", kLine - 1, "N10 G1 F6000");
  else if (line == kLines - 4) snprintf(text, kLine + 1, "%-*s\n", kLine - 1, "M98 P2000");
  else if (line == kLines - 3) snprintf(text, kLine + 1, "%-*s\n", kLine - 1, "#1=#1+1");
  else if (line == kLines - 2) snprintf(text, kLine + 1, "%-*s\n", kLine - 1, "IF[#1LT2]GOTO10");
  else if (line == kLines - 1) snprintf(text, kLine + 1, "%-*s\n", kLine - 1, "M30");
  else snprintf(text, kLine + 1, "X%-*.3f\n", kLine - 2, line % 2 != 0 ? 1.5 : 0.5);
}

typedef struct flash {
  unsigned long reads;
  size_t largest;
} flash;

/* nc_read_at: any place, any size; fewer bytes only at the end. */
static long read_flash(void* user, uint64_t offset, char* buffer, size_t size) {
  flash* const this = user;
  ++this->reads;
  if (size > this->largest) this->largest = size;
  size_t done = 0;
  while (done < size && offset + done < (uint64_t)kLine * kLines) {
    char text[kLine + 1];
    line_of_flash((unsigned)((offset + done) / kLine), text);
    buffer[done] = text[(offset + done) % kLine];
    ++done;
  }
  return (long)done;
}

static const char sub_program[] = "G4 P1\nM99\n";

/* nc_program_missing: called for "O2000", once; it stays in the store. */
static bool add_missing(void* user, nc_control* nc, const char* name) {
  unsigned* const added = user;
  if (strcmp(name, "O2000") != 0) return false; /* not added: the program stops on the dialect's alarm for a missing program */
  ++*added;
  return nc_program_add_text(nc, name, sub_program, strlen(sub_program), NULL) == NC_OK;
}

int main(void) {
  nc_config config;
  nc_config_init(&config);
  config.window_bytes = 512; /* never is more of the program in memory */
  config.look_ahead = 64;
  config.programs = 4;
  const size_t size = nc_memory_required(&config);
  void* memory = aligned_alloc(64, (size + 63) / 64 * 64);
  nc_status status = NC_E_MEMORY;
  nc_control* nc = memory != NULL ? nc_create(&config, memory, size, &status) : NULL;
  flash part = {0};
  unsigned file = 0, added = 0;
  if (nc != NULL) status = nc_program_add(nc, "O1000", read_flash, &part, (uint64_t)kLine * kLines, &file);
  if (nc != NULL) nc_program_on_missing(nc, add_missing, &added);
  if (status == NC_OK) status = nc_program_select(nc, 0, file);

  nc_item item = NC_INIT(nc_item);
  unsigned long moves = 0, dwells = 0;
  while (status == NC_OK || status == NC_BUDGET) {
    status = nc_pull(nc, 0, 100, &item);
    if (status == NC_OK && item.kind == NC_ITEM_MOVE) ++moves;
    if (status == NC_OK && item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_DWELL_SECONDS) ++dwells;
  }
  printf("%lu moves, %lu dwells of a sub program that was added %u time(s)\n", moves, dwells, added);
  printf("%s at once, %s read again\n", part.largest <= 512 ? "512 bytes or fewer" : "too much", part.reads > 300 ? "the text is" : "nothing is");
  printf("%s\n", nc_status_text(status));
  free(memory);
  return status == NC_ENDED ? 0 : 1;
}
