// SPDX-License-Identifier: Apache-2.0
// The command of the block in hand: what it is read with, what must hold of it as a whole, and the units of its numbers.
#pragma once

#include "command/command.hpp"

namespace nc {

struct InForce;
struct BlockInHand;
struct BlockContext;
struct Interpreter;
enum class Execution : uint8_t;
struct CoreQuestions;

/// Answers what the front end asks while it reads a block; the core of FrontEnd is the Interpreter.
extern const CoreQuestions kCoreAnswers;

/// Makes in.words of the block in hand, and checks what of it may stand together. Changes nothing else.
Execution read_block_command(Interpreter& in);

/// Words of the block in hand that belong to no axis in particular are increments.
bool is_incremental(const BlockInHand& in);

/// Applies the unit and distance modes to the axis words. To be called when the modal codes of the block are in force.
Execution resolve_axes(Interpreter& in);

/// Value of a length word (I J K R Q and the like) in mm, or of an angle word in deg (`rotary`). `setting_unit`: a word without a point counts in the
/// setting unit, otherwise in the command unit. `tenfold`: "UNIT*10" acts on it (M700 2.2).
double length_value(const InForce& in, Written number, bool rotary, bool setting_unit, bool tenfold = true);
double length_of(const BlockInHand& in, Role word, bool setting_unit = true);
/// The same of a word that has the name of an axis.
double length_of(const BlockInHand& in, WordSlot word, bool setting_unit = true);
/// Value of a position word of an axis, by the command unit of this axis (M700 2.1, #1015).
double axis_value(const InForce& in, unsigned axis, Written number, bool rotary);
/// Turns the F of the block into the number that becomes modal.
Execution feed_of(BlockInHand& in, double* feed);

}  // namespace nc
