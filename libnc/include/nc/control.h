/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file control.h
 * Create a control, and see and set its state. The headers that it includes have its configuration, tables, programs and dialects.
 *
 * Threads: unless a function says otherwise it belongs to the *feeder* thread (one thread, the one that calls nc_feed() or
 * nc_pull()). Only functions marked NC_RT belong to the scan thread. Two different controls never share anything.
 * Errors: a control that is NULL is NC_E_ARGUMENT, as is NULL for a pointer that a function needs. Functions without a status do nothing then, nor for a
 * part system that does not exist.
 * Ownership: everything lives in the memory given to nc_create(); pointers returned are valid as long as the control.
 */
#ifndef NC_CONTROL_H
#define NC_CONTROL_H

#include "nc/config.h"
#include "nc/dialects.h"
#include "nc/item.h"
#include "nc/program.h"
#include "nc/tables.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the control ---------------------------------------------------------------------------------------------- */

/**
 * Bytes that nc_create() needs for a configuration. Any thread.
 * @param config the configuration
 * @return bytes; 0 when the configuration is refused: nc_config_check() says why
 */
NC_API size_t nc_memory_required(const nc_config* config);

/**
 * Build a control in memory of the caller; nothing else is ever allocated. Any thread.
 * @param config the configuration; copied
 * @param memory aligned to 64 bytes, kept by the caller for as long as the control is used; its contents do not matter
 * @param size bytes of `memory`, at least nc_memory_required()
 * @param status receives NC_OK; NC_E_ARGUMENT: the configuration is refused (nc_config_check() says why), or `memory` is NULL or not
 *               aligned; NC_E_MEMORY: `size` is too small. May be NULL.
 * @return the control, or NULL. There is nothing to destroy: when it is no longer used, reuse the memory.
 */
NC_API nc_control* nc_create(const nc_config* config, void* memory, size_t size, nc_status* status);

/**
 * The dialect of a control, as it was configured. Any thread.
 * @param control the control; NULL: the dialect that nc_config_init() writes
 * @return the controller family
 */
NC_API nc_dialect nc_control_dialect(const nc_control* control);

/* ---- state ---------------------------------------------------------------------------------------------------- */

/**
 * Set the position of the machine while nothing runs; all axes count as referenced. Not between nc_restart_begin() and the cycle start at the place (nc/restart.h): set it
 * in front of nc_restart_begin(), or give the place up with nc_restart_cancel() first. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param machine machine coordinates, mm or deg, between -1e9 and 1e9; copied
 * @return NC_OK; NC_E_STATE: a program runs, or a place to begin at is looked for or found; NC_E_ARGUMENT: no such part system, `machine` is NULL, or a coordinate is out of range
 */
NC_API nc_status nc_position_set(nc_control* control, unsigned system, const nc_axes* machine);

/**
 * Convert positions to what the position counters show. The type of a rotary axis (M700 14.13: #8213) decides: with types 0, 1 and 2 its machine
 * coordinate, and with types 0 and 1 its workpiece coordinate, is shown as 0 <= angle < 360. In items, events and set-points the angle of such
 * an axis counts on over several turns. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param machine machine coordinates, mm or deg, which are replaced by what is shown. May be NULL.
 * @param work workpiece coordinates, mm or deg, which are replaced by what is shown. May be NULL.
 */
NC_API void nc_position_shown(const nc_control* control, unsigned system, nc_axes* machine, nc_axes* work);

/**
 * Set the switches of the operator that act when a block is read; blocks that were read already are not read again. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param optional_skip bit n = optional block skip switch n (1 to 9) is on; bit 1 is that of the plain '/'
 * @param mirror_axes bit i: the next program is mirrored from its beginning, in axis i, about the position where the axis stands at that time
 */
NC_API void nc_switches_set(nc_control* control, unsigned system, uint32_t optional_skip, uint32_t mirror_axes);

/**
 * The alarm that stopped a part system, of its program or of the control itself (NC-INTERNAL). Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param alarm receives a copy
 * @return NC_OK; NC_E_NOT_FOUND: there is no alarm (a stop by nc_inputs::alarm is none of the control); NC_E_ARGUMENT: no such part system, a
 *         pointer is NULL, or its struct_size is not valid
 */
NC_API nc_status nc_alarm_get(const nc_control* control, unsigned system, nc_alarm* alarm);

/**
 * Short text of an alarm: the text that the host gives (nc_config::alarm_text), else the one of the dialect's manual. Feeder thread.
 * @param control the control
 * @param code code of the alarm, as in nc_alarm::code
 * @param text receives the text, cut to `size` bytes with its NUL; NC_MAX_TEXT bytes are enough
 * @param size bytes of `text`
 * @return NC_OK; NC_E_NOT_FOUND: neither the host nor the dialect has a text for this code; NC_E_ARGUMENT: a pointer is NULL, or `size` is 0
 */
NC_API nc_status nc_alarm_text_get(const nc_control* control, const char* code, char* text, size_t size);

/**
 * What a status means: the text that the host gives (nc_config::alarm_text, asked by the name of the status, "NC_E_STATE"), else nc_status_text().
 * Feeder thread.
 * @param control the control
 * @param status what a call has returned; any other number has a sentence, too
 * @param text receives the text, cut to `size` bytes with its NUL; NC_MAX_TEXT bytes are enough
 * @param size bytes of `text`
 * @return NC_OK; NC_E_ARGUMENT: a pointer is NULL, or `size` is 0
 */
NC_API nc_status nc_status_text_get(const nc_control* control, nc_status status, char* text, size_t size);

/**
 * The blocks that led to the alarm of nc_alarm_get(), outermost first: each of them called the program of the next one, the last is the block of
 * the alarm (nc_alarm::source). An interrupt program counts as called by the block that it interrupted. When nc_inputs::alarm has stopped a
 * program, the blocks lead to the one that was in execution then, until reset; the host itself knows the text of that alarm. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param calls receives the first `capacity` of these blocks
 * @param capacity elements of `calls`; NC_MAX_CALLS are always enough
 * @return the number of blocks, at most `capacity`; 0 when there is no alarm, it has not stopped a program, or its block is not known
 */
NC_API unsigned nc_alarm_calls_get(const nc_control* control, unsigned system, nc_source* calls, unsigned capacity);

/**
 * Modal snapshot of a mark. Snapshots stay readable for at least `look_ahead` marks. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param id nc_mark::modal, or nc_outputs::modal
 * @param modal receives a copy
 * @return NC_OK; NC_E_NOT_FOUND: no such snapshot, or no longer; NC_E_ARGUMENT: no such part system, a pointer is NULL, or its struct_size
 *         is not valid
 */
NC_API nc_status nc_modal_get(const nc_control* control, unsigned system, uint32_t id, nc_modal* modal);

/**
 * The active G codes of a modal snapshot as text, "G01" "G17" "G54.1", for sinks that print. Any thread.
 * @param control the control
 * @param modal the snapshot
 * @param codes receives the codes in the order of their groups, each with its NUL
 * @param capacity elements of `codes`; NC_GROUPS are enough
 * @return the number of codes; 0 also when a pointer is NULL
 */
NC_API unsigned nc_modal_codes_get(const nc_control* control, const nc_modal* modal, char (*codes)[8], unsigned capacity);

/**
 * Text of a message. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param id nc_action::text, or nc_outputs::message_text
 * @param text receives a copy
 * @return NC_OK; NC_E_NOT_FOUND: no such text, or no longer; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_text_get(const nc_control* control, unsigned system, uint32_t id, nc_text* text);

/* ---- devices and the macro interface -------------------------------------------------------------------------- */

/**
 * Reads a device of the PLC for #100110 (M700 13.5.5). Feeder thread.
 * @param user what nc_device_on_read() was given
 * @param code kind of device, by the manual's table
 * @param number of the device
 * @param value receives the state: 0 or 1 of a bit device, 16 bits of a word device
 */
typedef void (*nc_device_read)(void* user, unsigned code, uint32_t number, uint32_t* value);

/**
 * Set the function that reads devices of the PLC. Without one the devices do not exist, and reading one is an alarm (P39). Feeder thread.
 * @param control the control
 * @param callback called in the feeder thread; NULL = no function
 * @param user handed to it
 */
NC_API void nc_device_on_read(nc_control* control, nc_device_read callback, void* user);

/**
 * Tell the interpreter which macro interface outputs (#1132 to #1135) are on at the machine. A program that reads them gets these values until it
 * writes them itself; the outputs themselves are not changed. Call it before nc_program_select() or nc_mdi_load(), since blocks that were
 * already read ahead are not read again. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param word 0..3: #1132 to #1135
 * @param mask the bits that are given
 * @param bits their values; bits outside `mask` do not count
 * @return NC_OK; NC_E_ARGUMENT: no such part system or word
 */
NC_API nc_status nc_interface_output_set(nc_control* control, unsigned system, unsigned word, uint32_t mask, uint32_t bits);

/**
 * Macro interface outputs (#1132 to #1135) after the blocks that the interpreter has read so far, for sinks. What the machine gets is in
 * nc_outputs::output. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param word 0 to NC_WORDS - 1
 * @param bits receives 32 outputs, bit 0 the first
 * @return NC_OK; NC_E_ARGUMENT: no such part system or word, or `bits` is NULL
 */
NC_API nc_status nc_interface_output_get(const nc_control* control, unsigned system, unsigned word, uint32_t* bits);

/* ---- the library ---------------------------------------------------------------------------------------------- */

/**
 * Version of the library. Any thread; needs no control.
 * @return "0.1.0", constant
 */
NC_API const char* nc_version(void);

#ifdef __cplusplus
}
#endif
#endif
