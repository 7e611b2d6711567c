/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file control.h
 * Create and configure a control, give it programs, set its tables.
 *
 * Threads: unless a function says otherwise it belongs to the *feeder* thread (one thread, the one that calls nc_feed() or
 * nc_pull()). Only functions marked NC_RT belong to the scan thread. Two different controls never share anything.
 * Ownership: everything lives in the memory given to nc_create(); pointers returned are valid as long as the control.
 */
#ifndef NC_CONTROL_H
#define NC_CONTROL_H

#include "nc/item.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One axis. Zero means "no limit" for the limits, so a control that only traces needs a name and nothing else. Limits are at most 1e12, places
 *  between -1e9 and 1e9. */
typedef struct nc_axis_config {
  char name;               /**< address letter, A B C U V W X Y Z */
  bool rotary;             /**< degrees instead of mm */
  double rapid;            /**< rapid traverse rate, mm/s or deg/s; 0 = max_velocity */
  double max_velocity;     /**< mm/s or deg/s, also the cutting feed clamp of the axis */
  double max_acceleration; /**< mm/s^2 or deg/s^2 */
  double max_jerk;         /**< mm/s^3 or deg/s^3 */
  double in_position;      /**< in-position width, mm or deg */
  bool soft_limited;       /**< the two limits below hold */
  double soft_min, soft_max; /**< stored stroke limits, machine coordinates */
  double reference[4];     /**< 1st to 4th reference position, machine coordinates */
  uint8_t spindle;         /**< number of the spindle that is this axis while its servo is on (M700 10.5: C axis; rotary), 0 = none */
} nc_axis_config;

/** One part system. */
typedef struct nc_system_config {
  uint8_t axis_count;
  nc_axis_config axis[NC_MAX_AXES];
  uint8_t spindle_count;   /**< 1..NC_MAX_SPINDLES; 0 = one */
} nc_system_config;

/** How the machine moves along the path. */
typedef enum nc_motion_mode {
  NC_MOTION_TRAPEZOID = 0, /**< axis velocity and acceleration; jerk is not limited */
  NC_MOTION_OPTIMAL = 1    /**< the least time that keeps velocity, acceleration and jerk of every axis; each axis needs all three */
} nc_motion_mode;

/** Common variables that a machine has beside those of its option: #400 to #499. */
typedef struct nc_variable_range {
  uint32_t first, last;    /**< 34 to 999999, at most 10000 of them; both 0 = none */
} nc_variable_range;

/** What a control is. Fill with nc_config_init(), then change what differs. */
typedef struct nc_config {
  uint32_t struct_size;    /**< sizeof(nc_config), set by nc_config_init() */
  uint8_t dialect;         /**< nc_dialect */
  uint8_t system_count;    /**< 1..NC_MAX_SYSTEMS */
  nc_system_config system[NC_MAX_SYSTEMS];
  double cycle_s;          /**< servo cycle, s, 1e-6..0.1; default 0.001 */
  uint32_t look_ahead;     /**< records in the ring between feeder and scan, power of two 64..65536; default 1024 (13 MB).
                                Time-optimal: short lines run at full speed where those in the ring, two records each, are longer than a stop:
                                16384 (75 MB) for lines of 1 um */
  uint32_t programs;       /**< entries of the program store; default 256 */
  uint32_t tool_offsets;   /**< sets; default 200 */
  uint32_t work_offsets;   /**< G54.1 P1..Pn; default 96 */
  uint32_t variable_sets;  /**< common variables by option, 100 200 300 600 (M700 13.4); default 600 */
  bool extended_variables; /**< #900000-#907399 of later models; default false */
  uint32_t window_bytes;   /**< text window per part system, 512..16777216; default 65536 */
  double max_feed_override; /**< largest value of nc_inputs::feed_override, default 2.0 */
  uint8_t motion_mode;     /**< nc_motion_mode; default NC_MOTION_TRAPEZOID */
  double path_tolerance;   /**< NC_MOTION_OPTIMAL: lines leave the programmed path by this at most, mm, 1e-5..10;
                                0: not at all, with a rest at each corner; default 0.01 */
  nc_variable_range variable_ranges[NC_VARIABLE_RANGES]; /**< shared by all part systems; apart from one another, from those of the options
                                and from local and system variables */
} nc_config;

/** Set every field to its default: M700, one part system with X Y Z without limits. */
NC_API void nc_config_init(nc_config* config);

/**
 * Whether nc_config::variable_ranges[index] can be had.
 * @param taken receives the first number of it that is another variable's already; 0 when the range itself is wrong. May be NULL.
 * @return NC_OK, also for no range; NC_E_ARGUMENT
 */
NC_API nc_status nc_variable_range_check(const nc_config* config, unsigned index, uint32_t* taken);

/** Bytes that nc_create() needs for this configuration; 0 when the configuration is not valid. */
NC_API size_t nc_memory_required(const nc_config* config);

/**
 * Build a control in caller-owned memory (aligned to 64 bytes; nothing else is ever allocated).
 * @return the control, or NULL with *status saying why. There is nothing to destroy: when it is no longer used, reuse the memory.
 */
NC_API nc_control* nc_create(const nc_config* config, void* memory, size_t size, nc_status* status);

/* ---- parameters, tables, variables ------------------------------------------------------------------------------ */

/**
 * Set a control parameter by the manual's number or name.
 * @param key  "1078", "1267/bit0", "UNIT*10", DGSHAPE "interpretation", ...; a number that the dialect has but that changes nothing
 *             here is accepted and kept; any other key is NC_E_NOT_FOUND.
 * @param axis axis name for a per-axis parameter, or 0 for all axes.
 * @param text value as text: a number, or a word of the manual ("B" for #1003).
 */
NC_API nc_status nc_parameter_set(nc_control*, unsigned system, const char* key, char axis, const char* text);

/** Value of a numeric parameter (0 when never set). */
NC_API nc_status nc_parameter_get(const nc_control*, unsigned system, const char* key, char axis, double* value);

/** Work offset tables. `index` 0 = external, 1..6 = G54..G59, 100+n = G54.1 Pn. mm/deg. */
NC_API nc_status nc_work_offset_set(nc_control*, unsigned system, unsigned index, unsigned axis, double value);
NC_API nc_status nc_work_offset_get(const nc_control*, unsigned system, unsigned index, unsigned axis, double* value);

/** Tool offset columns (M700 12.1). In memory type I all columns but NC_TOOL_LENGTH are unused. */
typedef enum nc_tool_column { NC_TOOL_LENGTH = 0, NC_TOOL_LENGTH_WEAR = 1, NC_TOOL_RADIUS = 2, NC_TOOL_RADIUS_WEAR = 3 } nc_tool_column;
NC_API nc_status nc_tool_offset_set(nc_control*, unsigned number, nc_tool_column column, double value);
NC_API nc_status nc_tool_offset_get(const nc_control*, unsigned number, nc_tool_column column, double* value);

/** Local and common variables by number, as part system `system` has them (system variables: NC_E_NOT_FOUND). Vacant: *vacant = true. */
NC_API nc_status nc_variable_set(nc_control*, unsigned system, uint32_t number, double value, bool vacant);
NC_API nc_status nc_variable_get(const nc_control*, unsigned system, uint32_t number, double* value, bool* vacant);

/**
 * Parameter `index` of those that have been set, in the order in which they first were; NC_E_NOT_FOUND behind the last. One bit that was set
 * ("1267/bit0") shows as its whole parameter.
 * @param axis axis name, 0 = all axes
 * @param set  false: it was set and that was taken back; *value and text mean nothing
 * @param text of a parameter that is one of two characters or more, at most 63; else "" and *value holds
 */
NC_API nc_status nc_parameter_next(const nc_control*, unsigned system, unsigned index, char key[24], char* axis, bool* set, double* value,
                                   char text[64]);

/**
 * What parameters that are set do not do on this machine, and where a time constant and not the feed is what limits it (docs/motion.md,
 * "Behind interpolation"): sentence `index`, in the order of their numbers, then of the axes; NC_E_NOT_FOUND behind the last.
 * @param text receives the sentence, cut to `size` bytes with its NUL; 200 are enough
 */
NC_API nc_status nc_parameter_note(const nc_control*, unsigned system, unsigned index, char* text, size_t size);

/**
 * Calls `look` while variables, their names, offsets and parameters are as the blocks have left them that the machine has executed: what is to
 * be kept while the power is off. What was read ahead and is not done shows again behind the call. `look` only reads.
 */
typedef void (*nc_look)(void* user, const nc_control*);
NC_API void nc_look_executed(nc_control*, nc_look look, void* user);

/** First common variable with number >= `from` that is not vacant. NC_E_NOT_FOUND when there is none. */
NC_API nc_status nc_common_next(const nc_control*, unsigned system, uint32_t from, uint32_t* number, double* value);

/* ---- programs --------------------------------------------------------------------------------------------------- */

/**
 * Reads up to `size` bytes of a text at byte `offset` into `buffer`.
 * @return bytes read; 0 at the end; negative on failure: NC_READ_FAILED, or NC_READ_CHANGED. Either becomes an alarm on the block that
 *         needed it; nothing of what is in `buffer` then acts.
 */
typedef long (*nc_read_at)(void* user, uint64_t offset, char* buffer, size_t size);

/** The text cannot be read (any negative number but the one below means the same). */
#define NC_READ_FAILED (-1L)
/** The text is no longer the one that was entered: somebody has written into its file. */
#define NC_READ_CHANGED (-2L)

/**
 * Enter a text into the program store. It is read in windows, never whole, and again wherever a program jumps: the text behind `read`
 * must stay unchanged from here until its entry is replaced or removed. What comes from a file, which anybody may overwrite meanwhile, is
 * therefore copied by the host, or watched: this library's own hosts (ncrtd, ncsim) keep a copy of a file of up to 16 MiB, and of a
 * larger one compare size, time, place and a hash of each part with what they were; their `read` then gives NC_READ_CHANGED.
 * @param name file name without folder, at most NC_MAX_NAME - 1 bytes; "O1000", "1000", "1000.nc" make it program 1000 even when the text
 *             has no O line. Copied.
 * @param file receives its index (nc_source::file). An entry of the same name is replaced, unless it runs (online)
 *             or is protected (M700 #8105: O8000 to O9999, #1121: O9000 to O9999): NC_E_STATE.
 * @return NC_E_MEMORY when all places (nc_config::programs) are taken: nc_program_remove() frees one. MDI needs none of them.
 */
NC_API nc_status nc_program_add(nc_control*, const char* name, nc_read_at read, void* user, uint64_t size, unsigned* file);

/** The same for a text in memory, which the caller keeps. */
NC_API nc_status nc_program_add_text(nc_control*, const char* name, const char* text, size_t length, unsigned* file);

/** What a place of the program store holds. */
typedef struct nc_program_info {
  char name[NC_MAX_NAME];
  uint32_t number;      /**< O number of the name, 0 = none */
  uint64_t size;        /**< bytes of the text */
  uint64_t used;        /**< counts when it was entered, selected or called last: of two entries the larger one was so later */
  bool in_use;          /**< something refers to it: see nc_program_remove() */
  bool is_protected;    /**< M700 #8105, #1121 */
} nc_program_info;
/** Of the entry with this index. NC_E_NOT_FOUND when the place is free. */
NC_API nc_status nc_program_get(const nc_control*, unsigned file, nc_program_info* info);

/**
 * Take a text out of the program store: nothing of it is read any more, and its index may come back for another one.
 * @return NC_E_STATE while something refers to it: it is selected in a part system, in a call stack (also one that comes back when blocks
 *         that were read ahead are taken back), the program of a modal call or of the macro interrupt; or it is protected
 */
NC_API nc_status nc_program_remove(nc_control*, unsigned file);

/**
 * Asked when a sub program is not in the store: the host may add it with nc_program_add() from inside this call.
 * @param name "O1000" or the name between < >; for M198 with "198:" before it, for M98 ,D1 to ,D4 with "D1:" to "D4:". To be added under this name.
 * @return true when it has been added.
 */
typedef bool (*nc_program_missing)(void* user, nc_control*, const char* name);
NC_API void nc_program_on_missing(nc_control*, nc_program_missing callback, void* user);

/**
 * The text of a program is being edited, or no longer: a program that begins meanwhile raises the alarm for it (M700 P235). One that runs
 * cannot be edited: NC_E_STATE.
 */
NC_API nc_status nc_program_edit(nc_control*, unsigned file, bool editing);

/** What the bytes of a program are. */
typedef enum nc_tape {
  NC_TAPE_NONE,  /**< text, all of it significant */
  NC_TAPE_TEXT,  /**< text with a label in front: up to the first end of block nothing is significant (M700 3.1) */
  NC_TAPE_ISO,   /**< rows of a punched tape with such a label, ISO code R-840: an even number of holes in each row */
  NC_TAPE_EIA    /**< the same in EIA code RS-244: an odd number */
} nc_tape;

/**
 * The program is an image of a tape, one byte for each row, hole 1 its lowest bit. Every row is checked as its block is read, and the
 * number of characters of a block where the parity V parameter of the input device says so (M700 3.6: #9115 to #9515). A program that
 * runs from a tape cannot jump.
 * @param tape nc_tape
 * @param unit input device that has read it, 1 to 5
 * @return NC_E_STATE while the program runs, NC_E_READ when its text cannot be read
 */
NC_API nc_status nc_program_tape(nc_control*, unsigned file, uint8_t tape, unsigned unit);

/** Select the main program of a part system and go to its first block. */
NC_API nc_status nc_program_select(nc_control*, unsigned system, unsigned file);

/** Give the blocks of an MDI program (copied; at most 1024 bytes) and select it. */
NC_API nc_status nc_mdi_load(nc_control*, unsigned system, const char* text, size_t length);

/* ---- state ------------------------------------------------------------------------------------------------------ */

/** Put the machine at this place (machine coordinates) while nothing runs; all axes count as referenced. */
NC_API nc_status nc_position_set(nc_control*, unsigned system, const nc_axes* machine);

/**
 * Positions as the counters show them: machine coordinates of rotary axes of #8213 = 0, 1 and 2, and workpiece coordinates of #8213 = 0
 * and 1, as 0 <= angle < 360 (M700 14.13). In items, events and set-points such an axis counts on over its turns. Either may be NULL.
 */
NC_API void nc_position_shown(const nc_control*, unsigned system, nc_axes* machine, nc_axes* work);

/** Name of a common variable (SETVN; M700 13.5.5), "" = none. `name` takes 8 bytes. */
NC_API nc_status nc_variable_name_get(const nc_control*, uint32_t number, char name[8]);
/** Give #500..#519 a name that was kept while the power was off; "" takes it away. */
NC_API nc_status nc_variable_name_set(nc_control*, uint32_t number, const char* name);

/**
 * What #100110 reads (M700 13.5.5): device `code` of the manual's table, its number; a bit device gives 0 or 1, a word device 16 bits.
 * Feeder thread. Without a callback the devices do not exist (P39).
 */
typedef void (*nc_device_read)(void* user, unsigned code, uint32_t number, uint32_t* value);
NC_API void nc_device_on_read(nc_control*, nc_device_read callback, void* user);

/** Macro interface outputs as the interpreter holds them (#1132..#1135), for sinks; the machine's own image is in nc_outputs. */
NC_API uint32_t nc_interface_output(const nc_control*, unsigned system, unsigned word);

/**
 * Switches that decide before a block is read. `optional_skip` bit n = switch n (1..9), bit 1 is the plain '/'. `mirror_axes` bit i: the next
 * program, from its head on, is mirrored in axis i about where the axis stands then.
 */
NC_API void nc_switches_set(nc_control*, unsigned system, uint32_t optional_skip, uint32_t mirror_axes);

/** The alarm that stopped a part system. NC_E_NOT_FOUND when there is none. Copies. */
NC_API nc_status nc_alarm_get(const nc_control*, unsigned system, nc_alarm* alarm);

/**
 * The blocks that led to that alarm, outermost first: each of them called the program of the next one, the last is the block of the alarm
 * (nc_alarm::source). An interrupt program counts as called by the block that it interrupted.
 * @param calls receives the first `capacity` of them; NC_MAX_CALLS are all
 * @return their number; 0 when there is no alarm, or its place is not known
 */
NC_API unsigned nc_alarm_calls(const nc_control*, unsigned system, nc_source* calls, unsigned capacity);

/** Modal snapshot of a mark. Snapshots stay readable for at least `look_ahead` marks. */
NC_API nc_status nc_modal_get(const nc_control*, unsigned system, uint32_t id, nc_modal* modal);

/** Active G codes of a snapshot as text, "G01 G17 G54.1": for sinks that print. @return number of codes. */
NC_API unsigned nc_modal_codes(const nc_control*, const nc_modal* modal, char (*codes)[8], unsigned capacity);

/** Text of a message action. */
NC_API nc_status nc_text_get(const nc_control*, unsigned system, uint32_t id, nc_text* text);

/** One row of a dialect's function table, for documentation and HMIs. */
typedef struct nc_function {
  char code[8];         /**< "G02.1", "M98" */
  uint8_t group;        /**< modal group, 0 = one-shot */
  bool supported;       /**< false: raises `alarm` when used */
  const char* part;     /**< what of a supported function is not built, nullptr = nothing that is known */
  char alarm[16];
  const char* name;     /**< short English name */
  const char* section;  /**< of the manual */
} nc_function;
/** Row `index` of the table of a dialect; NC_E_NOT_FOUND behind the last. Needs no control. */
NC_API nc_status nc_function_get(nc_dialect dialect, unsigned index, nc_function* row);

/** One range of system variables (M700 13.5.5), for documentation and HMIs. */
typedef struct nc_system_variable {
  uint32_t first, last;
  bool readable, writable;
  uint32_t sync;        /**< nc_sync_what: reading waits until everything before has happened; 0 = it is read ahead */
  const char* unit;
  const char* name;     /**< short English name */
  const char* section;  /**< of the manual */
} nc_system_variable;
/** Row `index` of the table; NC_E_NOT_FOUND behind the last. Needs no control. */
NC_API nc_status nc_system_variable_get(unsigned index, nc_system_variable* row);

/** Parameters that something in the control asks for, for documentation and HMIs. */
typedef struct nc_parameter {
  const char* key;            /**< of one with a name of its own ("UNIT*10"), nullptr = numbers */
  uint32_t first, last, step; /**< numbers: one, or several with the same meaning for one thing after the other */
  int8_t bit;                 /**< of the parameter, -1 = all of it */
  bool by_axis;               /**< may differ from axis to axis */
  const char* values;         /**< unit or values, what holds without it first; words of a parameter are apart by "|" */
  const char* name;           /**< short English name */
  const char* section;        /**< of the manual */
} nc_parameter;
/** Row `index` of the table of a dialect; NC_E_NOT_FOUND behind the last. Needs no control. */
NC_API nc_status nc_parameter_row(nc_dialect dialect, unsigned index, nc_parameter* row);
/** Something in the control asks for the parameter `key` ("1084", "1229/bit2", "UNIT*10"). One that it does not ask for is kept for
 *  programs that read it, and does nothing. Needs no control. */
NC_API bool nc_parameter_used(nc_dialect dialect, const char* key);

/** One row of a dialect's alarm table. */
NC_API nc_status nc_alarm_row(nc_dialect dialect, unsigned index, char code[16], const char** message);

/** Version of the library, "0.1.0". */
NC_API const char* nc_version(void);

#ifdef __cplusplus
}
#endif
#endif
