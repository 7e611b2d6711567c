/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file program.h
 * The programs of a control: its store, what it does when one is missing, tapes, and which one runs next.
 * Threads, errors and ownership are as in control.h, unless a function says otherwise.
 */
#ifndef NC_PROGRAM_H
#define NC_PROGRAM_H

#include "nc/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Reads a piece of a text. Feeder thread.
 * @param user what nc_program_add() was given
 * @param offset of the first byte that is wanted, from 0
 * @param buffer receives the bytes
 * @param size how many are wanted
 * @return bytes read; 0 at the end; negative on failure: NC_READ_FAILED, or NC_READ_CHANGED. Either becomes an alarm on the block that needed the
 *         text; what is in `buffer` then is not used.
 */
typedef long (*nc_read_at)(void* user, uint64_t offset, char* buffer, size_t size);

/** The text cannot be read. Any other negative number except NC_READ_CHANGED means the same. */
#define NC_READ_FAILED (-1L)
/** The text is no longer the one that was entered: somebody has written to its file. */
#define NC_READ_CHANGED (-2L)

/**
 * Enter a text into the program store. It is read piece by piece, never as a whole, and read again wherever a program jumps: the text that `read`
 * gives must stay unchanged until its entry is replaced or removed. Anybody may overwrite a file meanwhile, so a host copies the text of a file
 * or watches the file: this library's own hosts (ncrtd, ncsim) keep a copy of a file of up to 16 MiB, and for a larger one compare size, time,
 * place and a hash of each part with what they were; their `read` gives NC_READ_CHANGED when one of them differs. Feeder thread.
 * @param control the control
 * @param name file name without folder, at most NC_MAX_NAME - 1 bytes; "O1000", "1000", "1000.nc" make it program 1000 even when the text has no O
 *             line. In a family whose program numbers have another letter it is that letter. Copied. An entry of the same name is replaced.
 * @param read gives pieces of the text, in the feeder thread
 * @param user handed to `read`
 * @param size bytes of the text
 * @param file receives the index of the entry (nc_source::file), from 0. May be NULL.
 * @return NC_OK; NC_E_ARGUMENT: `control` or `read` is NULL, there is no name, or it is too long; NC_E_STATE: the entry of this name runs (online)
 *         or is protected (M700 #8105: O8000 to O9999, #1121: O9000 to O9999); NC_E_MEMORY: all places (nc_config::programs) are taken,
 *         nc_program_remove() frees one. MDI programs take none of these places.
 */
NC_API nc_status nc_program_add(nc_control* control, const char* name, nc_read_at read, void* user, uint64_t size, unsigned* file);

/**
 * Enter a text that lies in memory into the program store. Feeder thread.
 * @param control the control
 * @param name as for nc_program_add()
 * @param text the text; not copied: the caller keeps it unchanged until its entry is replaced or removed
 * @param length bytes of `text`
 * @param file receives the index of the entry, from 0. May be NULL.
 * @return as nc_program_add()
 */
NC_API nc_status nc_program_add_text(nc_control* control, const char* name, const char* text, size_t length, unsigned* file);

/** What a place of the program store holds. */
typedef struct nc_program_info {
  NC_STRUCT_SIZE(nc_program_info); /**< see NC_STRUCT_SIZE */
  char name[NC_MAX_NAME]; /**< as it was given to nc_program_add() or nc_program_add_text() */
  uint32_t number;      /**< O number that the name stands for, 0 = none */
  uint64_t size;        /**< bytes of the text */
  uint64_t used;        /**< value of a counter that the control advances each time a program is entered, selected or called: the place with the
                             largest number was used last */
  bool in_use;          /**< something refers to the program, so nc_program_remove() refuses it */
  bool is_protected;    /**< a parameter protects its O number (M700 #8105, #1121) */
} nc_program_info;
/**
 * Clear it and set its size. Any thread.
 * @param info what is to be cleared; not NULL
 */
static inline void nc_program_info_init(nc_program_info* info) {
  const nc_program_info cleared = NC_INIT(nc_program_info);
  *info = cleared;
}

/**
 * What a place of the program store holds. Feeder thread.
 * @param control the control
 * @param file index of the place, from 0 to nc_config::programs - 1
 * @param info receives it
 * @return NC_OK; NC_E_NOT_FOUND: the place is free; NC_E_ARGUMENT: a pointer is NULL, or its struct_size is not valid
 */
NC_API nc_status nc_program_get(const nc_control* control, unsigned file, nc_program_info* info);

/**
 * Whether a parameter protects the number that a text of this name has or would have (M700 #8105, #1121), whether or not it is in the program store. For a host
 * with a folder of programs, which reads some of them only when they are called. Feeder thread.
 * @param control the control
 * @param name name of the text, for example "O9001.nc"; a path in front of it does not count
 * @param is_protected receives it
 * @return NC_OK; NC_E_ARGUMENT: a pointer is NULL, or the name is empty or too long for the program store
 */
NC_API nc_status nc_program_name_protected(const nc_control* control, const char* name, bool* is_protected);

/**
 * Take a text out of the program store. The text is not read any more, and its index may be given to another text. Feeder thread.
 * @param control the control
 * @param file its index
 * @return NC_OK; NC_E_NOT_FOUND: the place is free; NC_E_STATE: the program is protected, or something refers to it: it is selected in a part
 *         system, it is in a call stack (also in one that comes back when blocks that were read ahead are taken back), or it is the program of a
 *         modal call or of the macro interrupt; NC_E_ARGUMENT: `control` is NULL
 */
NC_API nc_status nc_program_remove(nc_control* control, unsigned file);

/**
 * Take a text out of the program store in the same way, also one that is protected: for a host that has the program as a file and reads it anew when it is
 * called again. Nothing is deleted by that, and what runs next is what the file has then. Feeder thread.
 * @param control the control
 * @param file its index
 * @return NC_OK; NC_E_NOT_FOUND: the place is free; NC_E_STATE: something refers to it, as above; NC_E_ARGUMENT: `control` is NULL
 */
NC_API nc_status nc_program_give_up(nc_control* control, unsigned file);

/**
 * Called when a sub program is not in the store: the host may add it with nc_program_add() from inside this call. Feeder thread.
 * @param user what nc_program_on_missing() was given
 * @param control the control
 * @param name "O1000" or the name between < >; for M198 with "198:" before it, for M98 ,D1 to ,D4 with "D1:" to "D4:" before it. The program has to
 *             be added under exactly this name.
 * @return true when the program has been added
 */
typedef bool (*nc_program_missing)(void* user, nc_control* control, const char* name);

/**
 * Set the function that is called for sub programs that are not in the store. Feeder thread.
 * @param control the control
 * @param callback called in the feeder thread, from inside nc_pull() or nc_feed(); NULL = no function
 * @param user handed to it
 */
NC_API void nc_program_on_missing(nc_control* control, nc_program_missing callback, void* user);

/**
 * Say that the text of a program is being edited, or no longer is. A program that begins while it is being edited, as the main program or by a call,
 * stops with an alarm (M700 P235). Feeder thread.
 * @param control the control
 * @param file its index
 * @param editing true: editing begins; false: it has ended
 * @return NC_OK; NC_E_STATE: the program runs, or is protected, and editing cannot begin; NC_E_ARGUMENT: the place is free
 */
NC_API nc_status nc_program_edit(nc_control* control, unsigned file, bool editing);

/** What the bytes of a program are. */
typedef enum nc_tape {
  NC_TAPE_NONE,  /**< text without a label: all of it is program */
  NC_TAPE_TEXT,  /**< text that begins with a label: everything up to the first end of block is skipped (M700 3.1) */
  NC_TAPE_ISO,   /**< rows of a punched tape, beginning with such a label, in ISO code R-840: each row has an even number of holes */
  NC_TAPE_EIA    /**< rows of a punched tape, beginning with such a label, in EIA code RS-244: each row has an odd number of holes */
} nc_tape;

/**
 * Say that a program is a tape. The bytes of NC_TAPE_ISO and NC_TAPE_EIA are the rows of the tape, hole 1 being the lowest bit. Every row is checked
 * as its block is read; the number of characters of a block is checked where the parity V parameter of the input device says so (M700 3.6: #9115 to
 * #9515). A program that runs from a tape cannot jump. Feeder thread.
 * @param control the control
 * @param file index of the program
 * @param tape nc_tape
 * @param unit input device that has read it, 1 to 5
 * @return NC_OK; NC_E_STATE: the program runs, or is protected; NC_E_READ: its text cannot be read; NC_E_ARGUMENT: the place is free, or a
 *         number is out of range
 */
NC_API nc_status nc_program_tape(nc_control* control, unsigned file, uint8_t tape, unsigned unit);

/**
 * Select the main program of a part system and go to its first block. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param file index of the program
 * @return NC_OK; NC_E_NOT_FOUND: there is no program with this index; NC_E_STATE: a program runs in this part system; NC_E_ARGUMENT: no such part
 *         system
 */
NC_API nc_status nc_program_select(nc_control* control, unsigned system, unsigned file);

/**
 * Take blocks of MDI. They become the main program; in a block stop they run with the next start, before the program. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param text the blocks; copied. In a block stop blank ones take back what waits, and the machine stops behind the blocks (NC_CAUSE_MDI_ENDED)
 * @param length bytes of `text`, at most 1024
 * @return NC_OK; NC_E_STATE: a program runs, or cannot be interrupted here (M700 12.4.4); NC_E_ARGUMENT: no such part system, `text` is NULL, or too long
 */
NC_API nc_status nc_mdi_load(nc_control* control, unsigned system, const char* text, size_t length);

/**
 * A hash over everything that decides how a program goes on after the blocks that were read so far: modes and words in force, the place in the
 * program and in those that have called it, position, variables, offsets, parameters, outputs. A program that comes to the same place twice with
 * the same hash, and gets nothing from outside in between (clock, inputs, a write by the host), never ends. The function reads every table, so
 * call it now and then, not for every block. Hashes of different versions of the library cannot be compared. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param hash receives it
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or `hash` is NULL
 */
NC_API nc_status nc_program_state_hash(const nc_control* control, unsigned system, uint64_t* hash);

#ifdef __cplusplus
}
#endif
#endif
