// SPDX-License-Identifier: Apache-2.0
// The subcommands of ncsim; see commands.hpp.
#include "tools/lib/commands.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "runtime/motion_choice.hpp"
#include "tools/lib/command_text.hpp"
#include "tools/lib/dialect_names.hpp"
#include "tools/lib/item_source.hpp"
#include "tools/lib/machine_choice.hpp"
#include "tools/lib/number_hints.hpp"
#include "tools/lib/number_text.hpp"
#include "tools/lib/offline_run.hpp"
#include "tools/lib/other_dialects.hpp"
#include "tools/lib/output_check.hpp"
#include "tools/lib/output_file.hpp"
#include "tools/lib/print_file.hpp"
#include "tools/lib/trace_writer.hpp"
#include "tools/lib/virtual_world.hpp"

namespace nc::tools {
namespace {

std::string number(double value) {
  char text[kNumberText];
  return std::string(text, number_text(value, text));
}

int exit_code(RunResult::How how) {
  switch (how) {
    case RunResult::How::kEnded:
    case RunResult::How::kReset:
      return kExitEnded;
    case RunResult::How::kAlarmed:
      return kExitAlarm;
    case RunResult::How::kEndless:
      return kExitEndless;
    default:
      return kExitError;
  }
}

/** Writes the trace: every event becomes a line. */
class TraceSink final : public RunSink {
 public:
  TraceSink(OutputFile* out, const nc_system_config& system, ItemSource* items)
      : out_(*out), writer_(out, system), items_(items) {}
  // In the items the positions of rotary axes go on counting over several turns; a trace shows them as the counters do. // M700 14.13
  void move(const nc_source& s, const nc_move& m) override {
    nc_move shown = m;
    items_->shown(&shown.machine, &shown.work);
    writer_.move(s, shown);
  }
  void skip_move(const nc_source& s, const nc_move& m, bool skipped) override {
    nc_move shown = m;
    items_->shown(&shown.machine, &shown.work);
    writer_.move(s, shown, &skipped);
  }
  void block(const nc_source& s, const nc_axes& work, const nc_axes& machine) override {
    nc_axes work_shown = work, machine_shown = machine;
    items_->shown(&machine_shown, &work_shown);
    writer_.block(s, work_shown, machine_shown);
  }
  void aux(const nc_source& s, char code, double value) override { writer_.aux(s, code, value); }
  void dwell(const nc_source& s, bool turns, double value) override { writer_.dwell(s, turns, value); }
  void sync(const nc_source& s, uint32_t what) override { writer_.sync(s, what); }
  void message(const nc_source& s, uint32_t port, const nc_text& text) override {
    writer_.message(s, port, text);
  }
  void alarm(const nc_alarm& alarm) override { writer_.alarm(alarm); }
  void end(const nc_source& s, bool ok, const nc_axes& work, const nc_axes& machine,
           uint32_t modal) override {
    nc_axes work_shown = work, machine_shown = machine;
    items_->shown(&machine_shown, &work_shown);
    writer_.end(s, ok, work_shown, machine_shown, modal, items_);
  }
  bool stop() const override { return out_.failed(); }

 private:
  OutputFile& out_;
  TraceWriter writer_;
  ItemSource* items_;
};

/** Only the result of the run counts. */
class ResultSink final : public RunSink {
 public:
  bool takes_moves() const override { return false; }
};

/** Passes everything on to the next sink, and writes the output for an external port into a file. */
class PrintSink final : public RunSink {
 public:
  PrintSink(RunSink* next, PrintFile* file) : next_(*next), file_(*file) {}
  bool takes_moves() const override { return next_.takes_moves(); }
  void move(const nc_source& s, const nc_move& m) override { next_.move(s, m); }
  void skip_move(const nc_source& s, const nc_move& m, bool skipped) override { next_.skip_move(s, m, skipped); }
  void block(const nc_source& s, const nc_axes& work, const nc_axes& machine) override {
    next_.block(s, work, machine);
  }
  void aux(const nc_source& s, char code, double value) override { next_.aux(s, code, value); }
  void dwell(const nc_source& s, bool turns, double value) override { next_.dwell(s, turns, value); }
  void sync(const nc_source& s, uint32_t what) override { next_.sync(s, what); }
  void message(const nc_source& s, uint32_t port, const nc_text& text) override {
    if (port != 0) file_.write(text);
    next_.message(s, port, text);
  }
  void alarm(const nc_alarm& alarm) override { next_.alarm(alarm); }
  void end(const nc_source& s, bool ok, const nc_axes& work, const nc_axes& machine,
           uint32_t modal) override {
    next_.end(s, ok, work, machine, modal);
  }
  bool stop() const override { return next_.stop() || !file_.good(); }

 private:
  RunSink& next_;
  PrintFile& file_;
};

/** Collects the moves for the drawing. */
class PlotSink final : public RunSink {
 public:
  PlotSink(ToolpathPlot* plot, nc_dialect dialect, const nc_system_config& system, ItemSource* items)
      : plot_(*plot), dialect_(dialect), system_(system), items_(*items) {}
  void move(const nc_source&, const nc_move& move) override {
    nc_axes zero = {};
    if (plot_.coordinates() == PlotCoordinates::kWork) items_.move_zero(&zero);
    PlotSide side;
    if (items_.move_side(&side.side, side.plane_axis)) plot_.set_side(side);
    if (!move.curved) return plot_.add_move(move, system_, zero);
    // A curve that is neither a line nor a circle is drawn in short pieces.
    constexpr double kPieceMm = 0.2, kMost = 4000;
    const auto pieces = static_cast<unsigned>(std::ceil(std::min(kMost, std::max(32.0, move.length / kPieceMm))));
    nc_move piece = move;
    piece.plane = NC_PLANE_NONE;
    for (unsigned k = 1; k <= pieces; ++k) {
      if (!items_.move_point(static_cast<double>(k) / pieces, &piece.machine)) return plot_.add_move(move, system_, zero);
      plot_.add_move(piece, system_, zero);
      piece.machine_start = piece.machine;
    }
  }
  // T selects a tool and a code changes it (M06): behind the first such code a T alone only prepares the next tool. In a program without one T changes the tool.
  void aux(const nc_source&, char code, double value) override {
    if (code == 'T') selected_ = value;
    const bool changes = code == 'M' && nc_code_role_get(dialect_, 'M', static_cast<uint32_t>(value)) == NC_CODE_TOOL_CHANGE;
    changer_ = changer_ || changes;
    if (changes || (code == 'T' && !changer_)) plot_.set_tool(selected_);
  }
  // For a program without moves the drawing shows the position of the tool.
  void end(const nc_source&, bool, const nc_axes& work, const nc_axes& machine, uint32_t) override {
    if (plot_.size() != 0) return;
    const nc_axes& at = plot_.coordinates() == PlotCoordinates::kWork ? work : machine;
    double place[3] = {};
    for (unsigned i = 0; i < system_.axis_count; ++i)
      if (const char name = system_.axis[i].name; name >= 'X' && name <= 'Z') place[name - 'X'] = at.v[i];
    plot_.add_point(true, place[0], place[1], place[2]);
  }

 private:
  double selected_ = 0.0;
  bool changer_ = false;
  ToolpathPlot& plot_;
  const nc_dialect dialect_;
  const nc_system_config& system_;
  ItemSource& items_;
};

RunResult run_session(Session* session, RunSink* sink, ItemSource* items, const RunLimits& limits,
                      bool one_pass, std::FILE* err) {
  VirtualWorld world(session->setup(), session->config().system[0]);
  RunProgress progress;
  progress.tell = [err](const nc_source& source, uint64_t blocks) {
    const std::string program = source.program != 0 ? " of O" + std::to_string(source.program) : "";
    std::fprintf(err, "note: line %u%s after %llu million blocks; a loop that moves never ends\n", source.line, program.c_str(),
                 static_cast<unsigned long long>(blocks / 1'000'000));
  };
  RunResult result = run_offline(items, &world, sink, session->decides(), limits.silent_blocks, one_pass, progress, limits.loops);
  if (result.how != RunResult::How::kFailed) note_unused(world.unused(), err);
  return result;
}

/** Runs the program and writes what it prints into `path` ("" = nowhere). @return false with *error when the file cannot be
 * written. */
bool run_printing(Session* session, RunSink* sink, ItemSource* items, const RunLimits& limits,
                  bool one_pass, const std::string& path, RunResult* result, std::string* error, std::FILE* err) {
  PrintFile file;
  if (path.empty()) {
    *result = run_session(session, sink, items, limits, one_pass, err);
    return true;
  }
  if (!file.open(path, error)) return false;
  PrintSink printing(sink, &file);
  *result = run_session(session, &printing, items, limits, one_pass, err);
  if (!file.good()) *error = path + ": cannot be written";
  return file.good();
}

constexpr uint32_t kLookAhead = 256;  // records of the ring: nothing is planned in it here, and a large one would only take time to make

bool open_session(Session* session, const SessionOptions& options, std::string* error) {
  std::unique_ptr<rt::Config> machine;
  if (!options.machine.empty() && !(machine = load_machine(options.machine, error))) return false;
  if (!session->configure(options, error, std::move(machine))) return false;
  const bool limited =
      session->machine() == nullptr || set_machine_limits({}, session->machine(), &session->config(), error);
  session->config().look_ahead = std::min(session->config().look_ahead, kLookAhead);
  return limited && session->start(options, error);
}

// Writes a table as tab-separated lines, or as Markdown, in which bars in the cells are escaped.
class Table {
 public:
  Table(std::FILE* out, bool markdown) : out_(out), markdown_(markdown) {}
  void head(const std::vector<std::string>& cells) {
    row(cells);
    if (markdown_) row(std::vector<std::string>(cells.size(), "---"));
  }
  void row(const std::vector<std::string>& cells) {
    std::string line = markdown_ ? "| " : "";
    for (size_t i = 0; i < cells.size(); ++i) {
      if (i) line += markdown_ ? " | " : "\t";
      for (char c : cells[i]) line += markdown_ && c == '|' ? std::string("\\|") : std::string(1, c);
    }
    std::fprintf(out_, "%s%s\n", line.c_str(), markdown_ ? " |" : "");
  }

 private:
  std::FILE* out_;
  bool markdown_;
};

}  // namespace

int trace_command(const SessionOptions& options, const RunLimits& limits, int out, std::FILE* err) {
  Session session;
  std::string error;
  if (!open_session(&session, options, &error)) return complain(err, error);
  OutputFile file(out);
  ControlSource items(session.control(), session.dialect());
  TraceSink sink(&file, session.config().system[0], &items);
  RunResult result;
  if (!run_printing(&session, &sink, &items, limits, false, options.print, &result, &error, err))
    return complain(err, error);
  if (result.how == RunResult::How::kEndless) complain(err, options.program + ": " + result.error);
  if (!file.flush()) return complain(err, "the trace cannot be written: " + file.error_text());
  if (result.how == RunResult::How::kFailed) return complain(err, options.program + ": " + result.error);
  return exit_code(result.how);
}

namespace {

/** Prints a note on standard error for each parameter that is set but has no effect. */
void note_parameters(const Session& session, nc_dialect dialect, std::FILE* err) {
  constexpr const char* kNote = "nothing in the control asks for this parameter: it is kept for programs that read it";
  for (const SetupParameter& p : session.setup().parameters)
    if (!nc_parameter_used(dialect, p.key.c_str()))
      std::fprintf(err, "note: %s:%u: %s: %s\n", session.setup().name.c_str(), p.place.line, p.place.path.c_str(), kNote);
  if (session.machine() == nullptr) return;
  for (const rt::ParameterSetting& p : session.machine()->parameters)
    if (!nc_parameter_used(dialect, p.key.c_str()))
      std::fprintf(err, "note: %s:%u: %s: %s\n", session.machine()->file.c_str(), p.place.line, p.place.key.c_str(), kNote);
}

}  // namespace

int check_command(const SessionOptions& options, const RunLimits& limits, std::FILE* out, std::FILE* err) {
  Session session;
  std::string error;
  if (!open_session(&session, options, &error)) return complain(err, error);
  ControlSource items(session.control(), session.dialect());
  ResultSink nothing;
  RunResult result;
  if (!run_printing(&session, &nothing, &items, limits, true, options.print, &result, &error, err))
    return complain(err, error);
  if (session.machine() != nullptr)
    std::fprintf(err, "note: motion: %s\n", rt::motion_text(session.config(), session.machine()->motion_given).c_str());
  nc_parameter_note note;
  for (unsigned i = 0; nc_parameter_note_row(session.control(), kPartSystem, i, &note) == NC_OK; ++i)
    std::fprintf(err, "note: %s\n", note.text);
  if (result.how == RunResult::How::kFailed) return complain(err, options.program + ": " + result.error);
  if (result.how == RunResult::How::kEndless) complain(err, options.program + ": " + result.error);
  note_parameters(session, static_cast<nc_dialect>(session.config().dialect), err);
  const bool foreign_numbers = options.tape.empty() && note_numbers(session, err);
  if (result.how == RunResult::How::kAlarmed || foreign_numbers) {
    const std::string own = nc_dialect_name(static_cast<nc_dialect>(session.config().dialect));
    const bool alarmed = result.how == RunResult::How::kAlarmed;
    SessionOptions again = options;
    if (options.program == "-" && !session.main_text().empty()) again.text = session.main_text();  // what came from standard input is not there a second time
    const std::string other = other_dialect_note(again, limits, own, !alarmed);
    if (!other.empty()) std::fprintf(err, "%s\n", other.c_str());
  }
  if (result.how == RunResult::How::kAlarmed)
    std::fprintf(out, "%s\n", alarm_line(session, result.alarm).c_str());
  else
    std::fprintf(out, "%s: no alarm%s; %llu blocks, %llu moves, %s mm\n", options.program.c_str(),
                 result.how == RunResult::How::kEndless ? " until it was given up"
                 : result.one_pass                      ? " in one pass (it begins again by itself)"
                                                        : "",
                 static_cast<unsigned long long>(result.blocks),
                 static_cast<unsigned long long>(result.moves), decimals(result.length, 3).c_str());
  return close_output(out, err, exit_code(result.how));
}

int plot_command(const SessionOptions& options, const RunLimits& limits, const PlotOptions& how,
                 const std::string& base, std::FILE* out, std::FILE* err) {
  Session session;
  std::string error;
  if (!can_be_written(base + ".svg", &error) || !can_be_written(base + ".png", &error))
    return complain(err, error);
  if (!open_session(&session, options, &error)) return complain(err, error);
  ToolpathPlot plot;
  plot.set_view(how.view);
  plot.set_coordinates(how.coordinates);
  plot.set_color(how.color);
  const size_t slash = options.program.find_last_of('/');
  plot.set_title(options.program == "-" ? "standard input"
                                        : rt::valid_utf8(options.program.substr(slash == std::string::npos ? 0 : slash + 1)));
  ControlSource items(session.control(), session.dialect());
  PlotSink sink(&plot, static_cast<nc_dialect>(session.config().dialect), session.config().system[0], &items);
  const RunResult result = run_session(&session, &sink, &items, limits, true, err);
  if (result.how == RunResult::How::kFailed) return complain(err, options.program + ": " + result.error);
  if (result.how == RunResult::How::kEndless) {
    complain(err, options.program + ": " + result.error);
    plot.set_sentence("given up: " + result.error);
  }
  if (result.how == RunResult::How::kAlarmed) {
    plot.set_alarm(result.alarm.code);
    plot.set_sentence(alarm_line(session, result.alarm));
  }
  if (!plot.write_svg(base + ".svg", &error) || !plot.write_png(base + ".png", &error))
    return complain(err, error);
  if (result.how == RunResult::How::kAlarmed)
    std::fprintf(out, "%s\n", alarm_line(session, result.alarm).c_str());
  std::fprintf(out, "%s.svg %s.png: %llu moves, %s mm\n", base.c_str(), base.c_str(),
               static_cast<unsigned long long>(result.moves),
               number(std::round(result.length * 1000) / 1000).c_str());
  return close_output(out, err, exit_code(result.how));
}

namespace {

/// What a dialect has, counted from its tables. Codes that call a macro of the user where he registers it are not counted.
std::vector<std::string> dialect_row(nc_dialect id) {
  unsigned codes = 0, run = 0, part = 0, ranges = 0, parameters = 0;
  std::string misc;
  nc_function row;
  for (unsigned i = 0; nc_function_row(id, i, &row) == NC_OK; ++i) {
    if (row.code[0] == 'M') {
      if (row.supported) misc += (misc.empty() ? "" : " ") + std::string(row.code);
      continue;
    }
    if (row.name != nullptr && std::string_view(row.name).substr(0, 10) == "user macro") continue;
    ++codes;
    run += row.supported ? 1u : 0u;
    part += row.supported && row.part != nullptr ? 1u : 0u;
  }
  nc_system_variable variable{};
  while (nc_system_variable_row(id, ranges, &variable) == NC_OK) ++ranges;
  nc_parameter parameter;
  while (nc_parameter_row(id, parameters, &parameter) == NC_OK) ++parameters;
  return {nc_dialect_name(id), nc_dialect_title(id), std::to_string(run) + " of " + std::to_string(codes), std::to_string(part), misc, std::to_string(ranges),
          std::to_string(parameters)};
}

}  // namespace

int dialects_command(bool markdown, std::FILE* out, std::FILE* err) {
  Table table(out, markdown);
  table.head({"dialect", "programs of", "G codes that run", "of them not with all words", "M codes of the control itself", "ranges of system variables", "parameters"});
  for (const std::string& name : dialect_names()) table.row(dialect_row(*dialect_from_name(name)));
  return close_output(out, err, kExitEnded);
}

int functions_command(const std::string& dialect, bool markdown, std::FILE* out, std::FILE* err) {
  const auto id = dialect_from_name(dialect);
  if (!id) return complain(err, no_dialect(dialect));
  Table table(out, markdown);
  table.head({"code", "function", "group", "section", "supported", "alarm, or what is not built"});
  nc_function row;
  for (unsigned i = 0; nc_function_row(*id, i, &row) == NC_OK; ++i)
    table.row({row.code, row.name ? row.name : "", std::to_string(row.group), row.section ? row.section : "",
               !row.supported        ? "no"
               : row.part != nullptr ? "in part"
                                     : "yes",
               !row.supported        ? row.alarm
               : row.part != nullptr ? row.part
                                     : ""});
  return close_output(out, err, kExitEnded);
}

int variables_command(const std::string& dialect, bool markdown, std::FILE* out, std::FILE* err) {
  const auto id = dialect_from_name(dialect);
  if (!id) return complain(err, no_dialect(dialect));
  Table table(out, markdown);
  table.head({"variables", "what", "unit", "read", "written", "section"});
  nc_system_variable row;
  for (unsigned i = 0; nc_system_variable_row(*id, i, &row) == NC_OK; ++i) {
    std::string numbers = "#" + std::to_string(row.first);
    if (row.last != row.first) numbers += "-#" + std::to_string(row.last);
    table.row({numbers, row.name, row.unit,
               !row.readable   ? "no"
               : row.sync != 0 ? "waits for the machine"
                               : "ahead",
               row.writable ? "yes" : "no", row.section});
  }
  return close_output(out, err, kExitEnded);
}

int parameters_command(const std::string& dialect, bool markdown, std::FILE* out, std::FILE* err) {
  const auto id = dialect_from_name(dialect);
  if (!id) return complain(err, no_dialect(dialect));
  Table table(out, markdown);
  table.head({"parameter", "what", "unit or values", "by axis", "section"});
  nc_parameter row;
  for (unsigned i = 0; nc_parameter_row(*id, i, &row) == NC_OK; ++i) {
    std::string key = row.key != nullptr ? row.key : "#" + std::to_string(row.first);
    if (row.last != row.first) key += (row.step > 1 ? ", #" + std::to_string(row.first + row.step) + " ... #" : "-#") + std::to_string(row.last);
    if (row.bit >= 0) key += "/bit" + std::to_string(row.bit);
    std::string values = row.values;
    for (size_t at = 0; (at = values.find('|', at)) != std::string::npos; at += 2) values.replace(at, 1, ", ");
    table.row({key, row.name, values, row.by_axis ? "yes" : "", row.section});
  }
  return close_output(out, err, kExitEnded);
}

int alarms_command(const std::string& dialect, bool markdown, std::FILE* out, std::FILE* err) {
  const auto id = dialect_from_name(dialect);
  if (!id) return complain(err, no_dialect(dialect));
  Table table(out, markdown);
  table.head({"code", "message"});
  char code[16];
  const char* message = nullptr;
  for (unsigned i = 0; nc_alarm_row(*id, i, code, &message) == NC_OK; ++i)
    table.row({code, message ? message : ""});
  return close_output(out, err, kExitEnded);
}

}  // namespace nc::tools
