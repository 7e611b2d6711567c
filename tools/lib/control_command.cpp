// SPDX-License-Identifier: Apache-2.0
// See control_command.hpp.
#include "tools/lib/control_command.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#include "runtime/end_signal.hpp"
#include "runtime/programs/encoding.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/sha256.hpp"
#include "tools/lib/control_print.hpp"
#include "tools/lib/control_words.hpp"
#include "tools/lib/trace_csv.hpp"
#include "tools/lib/whole_file.hpp"

namespace nc::tools {
namespace {

using rt::services::Lane;
using rt::services::Service;
using rt::services::ServiceRow;
using Clock = std::chrono::steady_clock;

constexpr auto kJogPeriod = std::chrono::milliseconds(40);  // a jog has to be repeated within 200 scans
constexpr auto kLookPeriod = std::chrono::milliseconds(20);  // at which the end of a recording is looked for
constexpr std::size_t kChunk = rt::services::kChunkBytes;

struct CloseFile {
  void operator()(std::FILE* file) const {
    if (file != nullptr) std::fclose(file);
  }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// False when it cannot be written, which may be what there is to be said.
bool print_object(const ServiceRefusal& refusal, std::FILE* out) {
  const Json object{{"ok", false}, {"error", refusal.error}, {"text", refusal.text}};
  return std::ferror(out) == 0 && std::fprintf(out, "%s\n", json_text(object).c_str()) >= 0 && std::fflush(out) == 0;
}

// What is wrong in several lines of a file has as many lines.
void print_lines(const std::string& text, std::FILE* err) {
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::fprintf(err, "ncctl: %s\n", terminal_text(text.substr(at, end - at)).c_str());
    at = end + 1;
  }
}

// Whether all texts of the arguments are characters: others would ask for something else.
bool is_utf8(const Json& value) {
  if (value.is_string()) return rt::valid_utf8(value.get_ref<const std::string&>()) == value.get_ref<const std::string&>();
  return std::all_of(value.begin(), value.end(), [](const Json& member) { return !member.is_structured() && !member.is_string() ? true : is_utf8(member); });
}

class Command {
 public:
  Command(const ControlCommand& command, OpenRemote open_remote, std::FILE* in, std::FILE* out, std::FILE* err)
      : command_(command), open_remote_(open_remote), in_(in), out_(out), err_(err) {}

  int run() {
    using What = ControlCommand::What;
    if (command_.what == What::kDocument) return document();
    if (!is_utf8(command_.args)) return failed(kControlUsage, "the words of a command must be UTF-8");
    rt::catch_end_signals({SIGINT, SIGTERM, SIGHUP});
    if (!connect()) return status_;
    switch (command_.what) {
      case What::kWatch: return command_.args.contains("devices") ? watch_devices() : watch();
      case What::kJog: return jog();
      case What::kApproach: return approach();
      case What::kMdi: return mdi();
      case What::kPut: return put();
      case What::kGet: return get();
      case What::kPipe: return pipe();
      case What::kExport: return export_tables();
      case What::kImport: return import_tables();
      case What::kSwap: return swap_ladder();
      case What::kRecord: return record();
      case What::kSave: return save();
      default: return service();
    }
  }

 private:
  int failed(const ServiceRefusal& refusal) { return status_ = report_refusal(refusal, command_.json, out_, err_); }
  int failed(int status, const std::string& text) { return failed({status, status == kControlUsage ? "usage" : "failed", text}); }

  bool connect() {
    return command_.remote.used ? connect_remotely() : connect_locally();
  }
  bool connect_remotely() {
    if (open_remote_ == nullptr) return failed(kControlUsage, "this ncctl was built without DDS") == 0;
    if (command_.control.empty()) return failed(kControlUsage, "over DDS --control NAME says which control") == 0;
    ServiceRefusal refusal;
    RemoteAccess access = command_.remote;
    access.control = command_.control;
    client_ = open_remote_(access, &refusal);
    return client_ != nullptr || failed(refusal) == 0;
  }
  bool connect_locally() {
    std::string path = command_.socket;
    if (path.empty()) {
      std::vector<std::string> found = find_sockets();
      if (!command_.control.empty()) std::erase_if(found, [&](const std::string& one) { return one.substr(one.rfind('/') + 1) != command_.control + ".sock"; });
      std::string names;
      for (const std::string& one : found) names += " " + one;
      if (found.empty()) return failed({kControlNobody, "no connection", "no control has a socket in /run/ncrtd or in the user's folder: is ncrtd serve running?"}) == 0;
      if (found.size() > 1) return failed({kControlUsage, "usage", "several controls run, choose one with --control or --socket:" + names}) == 0;
      path = found.front();
    }
    ServiceRefusal refusal;
    client_ = open_local_client(path, &refusal);
    return client_ != nullptr || failed(refusal) == 0;
  }

  bool call(const std::string& service, const Json& args, Json* reply) {
    ServiceRefusal refusal;
    return client_->call(service, args, reply, &refusal) || failed(refusal) == 0;
  }
  // For a service. Who lacks the right to it asks for it without control, so that the control tells him what the service needs, which is not what control needs.
  bool take_control(Service service) {
    Json reply;
    return !client_->may_use(rt::services::row_of(service)) || call("control.take", Json::object(), &reply);
  }

  // False when the output cannot be written, which is no success of the command.
  bool print(const ServiceRow& row, const Json& reply) {
    to_ = out_;
    return write_out(command_.json ? json_line(reply) : reply_text(row, reply));
  }

  // A command needs control, which ends with this connection. A hold does not: it is taken from everyone.
  int service() {
    const ServiceRow& row = *rt::services::find_service(command_.service);
    if (row.lane == Lane::kCommand && !row.of_command().stops_at_once() && !take_control(row.service)) return status_;
    Json whole;
    Json args = command_.args;
    for (;;) {
      Json reply;
      if (!call(command_.service, args, &reply)) return status_;
      const std::uint64_t next = reply.value("next", std::uint64_t{0});
      add_page(&whole, std::move(reply));
      if (next == 0 || command_.args.contains("count")) break;
      args["from"] = next;
    }
    return print(row, whole) ? 0 : status_;
  }

  // Joins the pages of a list.
  static void add_page(Json* whole, Json page) {
    if (whole->is_null()) {
      *whole = std::move(page);
      return;
    }
    for (auto& [key, value] : page.items()) {
      if (!value.is_array()) (*whole)[key] = value;
      else for (Json& element : value) (*whole)[key].push_back(std::move(element));
    }
  }

  int watch() {
    const ServiceRow& row = rt::services::row_of(Service::kStatus);
    const auto begin = Clock::now();
    for (std::uint64_t line = 0; rt::end_signal() == 0; ++line) {
      Json reply;
      if (!call(row.name, Json::object(), &reply)) return status_;
      to_ = out_;
      if (!write_out(command_.json ? json_line(reply) : status_line(reply) + "\n")) return status_;
      const auto next = begin + std::chrono::duration<double>(static_cast<double>(line + 1) / command_.rate);
      if (command_.seconds > 0 && next - begin > std::chrono::duration<double>(command_.seconds)) return 0;
      std::this_thread::sleep_until(std::chrono::time_point_cast<Clock::duration>(next));
    }
    return 0;
  }

  // One line for each update: the scan and the values, in the order of the names in the first line. A line that says how many are missing comes in front of an update behind which this side has lagged.
  int watch_devices() {
    Json args = command_.args, reply;
    args["interval_ms"] = std::clamp(std::lround(1000 / command_.rate), static_cast<long>(rt::services::kShortestInterval), static_cast<long>(rt::services::kLongestInterval));
    if (!call("watch.begin", args, &reply)) return status_;
    std::string head = "scan";
    for (const Json& device : reply.value("devices", Json::array())) head += "\t" + terminal_text(device.value("name", ""));
    if (!command_.json) std::fprintf(out_, "%s\n", head.c_str());
    const auto end = Clock::now() + std::chrono::duration<double>(command_.seconds);
    while (rt::end_signal() == 0 && (command_.seconds == 0 || Clock::now() < end)) {
      Json update;
      ServiceRefusal refusal;
      if (!client_->next_update(&update, &refusal)) return failed(refusal);
      if (command_.json) {
        std::fputs(json_line(update).c_str(), out_);
      } else {
        if (const std::uint64_t missing = update.value("left_out", std::uint64_t{0}); missing != 0) std::fprintf(out_, "# %llu left out\n", static_cast<unsigned long long>(missing));
        std::string line = update.value("scan", Json()).dump();
        std::size_t place = 0;
        const Json held = update.value("forced", Json::array());
        for (const Json& value : update.value("values", Json::array())) {
          line += value.is_number() ? "\t" + value.dump() : "\t-";
          if (std::find(held.begin(), held.end(), Json(place++)) != held.end()) line += kForcedMark;
        }
        std::fprintf(out_, "%s\n", line.c_str());
      }
      if (std::fflush(out_) != 0) return failed(kControlFailed, "the output cannot be written");
    }
    return 0;
  }

  // The axis stops at the end, after a signal, and when this process is killed: a jog that is not repeated ends.
  int jog() {
    if (!take_control(Service::kJog)) return status_;
    const auto end = Clock::now() + std::chrono::duration<double>(command_.seconds);
    Json reply;
    while (rt::end_signal() == 0 && Clock::now() < end) {
      if (!call("jog", command_.args, &reply)) return status_;
      std::this_thread::sleep_for(kJogPeriod);
    }
    Json stop = command_.args;
    stop["velocity"] = 0;
    return call("jog", stop, &reply) && print(rt::services::row_of(Service::kJog), reply) ? 0 : status_;
  }

  // Until the axis is there, a signal, or a refusal. When this process is killed the axis stops, as a jog does.
  int approach() {
    if (!take_control(Service::kRestartApproach)) return status_;
    Json system = Json::object(), reply;
    if (command_.args.contains("system")) system["system"] = command_.args["system"];
    bool away = true;
    while (away && rt::end_signal() == 0) {
      if (!call("restart.approach", command_.args, &reply)) return status_;
      std::this_thread::sleep_for(kJogPeriod);
      if (!call("restart.status", system, &reply)) return status_;
      away = false;
      for (const Json& axis : reply.value("axes", Json::array()))
        if (axis.value("name", "") == command_.args["axis"]) away = axis.value("away", false);
    }
    Json stop = system;
    stop["axis"] = command_.args["axis"];
    stop["velocity"] = 0;
    if (!call("jog", stop, &reply)) return status_;
    if (away) return failed(kControlFailed, "the axis was stopped before it was there");
    return print(rt::services::row_of(Service::kRestartApproach), reply) ? 0 : status_;
  }

  int mdi() {
    Json reply;
    if (!take_control(Service::kMdi) || !call("mdi", command_.args, &reply)) return status_;
    Json system = Json::object();
    if (command_.args.contains("system")) system["system"] = command_.args["system"];
    if (command_.start && !call("start", system, &reply)) return status_;
    return print(rt::services::row_of(Service::kMdi), reply) ? 0 : status_;
  }

  // ---- programs ----

  // A file of this side, with its bytes in it: a device or a pipe has no end, or waits for somebody.
  static File regular_file(const std::string& path) {
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat info {};
    if (descriptor >= 0 && fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode)) return File(fdopen(descriptor, "rb"));
    const int why = descriptor < 0 ? errno : S_ISDIR(info.st_mode) ? EISDIR : ENODEV;
    if (descriptor >= 0) close(descriptor);
    errno = why;
    return nullptr;
  }

  static bool hash_of(std::FILE* file, std::uint64_t* size, std::string* hash) {
    rt::services::Sha256 sum;
    std::string bytes(kChunk, '\0');
    *size = 0;
    while (rt::end_signal() == 0) {
      const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file);
      sum.add({bytes.data(), count});
      *size += count;
      if (count < bytes.size()) break;
    }
    *hash = sum.finish();
    return std::ferror(file) == 0 && std::fseek(file, 0, SEEK_SET) == 0;
  }

  // Asked before the file is read, which takes a minute when it is far too long.
  bool has_room_for(std::FILE* file) {
    struct stat info {};
    Json reply;
    if (fstat(fileno(file), &info) != 0 || !call("programs.list", {{"count", 1}}, &reply)) return false;
    const std::uint64_t size = static_cast<std::uint64_t>(info.st_size), most = reply.value("most_bytes_of_one", std::numeric_limits<std::uint64_t>::max());
    return size <= most || failed(refusal_named("no space", "a program may have " + std::to_string(most) + " bytes, not " + std::to_string(size))) == 0;
  }

  int put() {
    const File file = regular_file(command_.file);
    std::uint64_t size = 0;
    std::string hash;
    if (file == nullptr && errno == ENODEV) return failed(kControlUsage, command_.file + ": is no regular file");
    if (file != nullptr && !has_room_for(file.get())) return status_;
    if (file == nullptr || !hash_of(file.get(), &size, &hash)) return failed(kControlUsage, command_.file + ": " + std::strerror(errno));
    if (rt::end_signal() != 0) return failed(kControlFailed, command_.file + ": was not sent");
    Json begin = command_.args, reply;
    if (!begin.contains("name")) begin["name"] = command_.file.substr(command_.file.rfind('/') + 1);
    if (!rt::services::is_program_name(begin["name"].get_ref<const std::string&>())) return failed(kControlUsage, "the name cannot be that of a program: --name gives another one");
    begin["size"] = size;
    begin["sha256"] = hash;
    if (!call("programs.begin", begin, &reply)) return status_;
    const Json upload = reply["upload"];
    std::string bytes(kChunk, '\0');
    for (std::uint64_t at = 0; at < size && rt::end_signal() == 0;) {
      const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
      if (count == 0) return failed(kControlFailed, command_.file + ": it has become shorter meanwhile");
      if (!call("programs.data", {{"upload", upload}, {"begin", at}, {"data", rt::services::to_base64({bytes.data(), count})}}, &reply)) return status_;
      at += count;
    }
    if (rt::end_signal() != 0) {
      (void)call("programs.abandon", {{"upload", upload}}, &reply);  // when this is refused, the end of the connection drops it
      return failed(kControlFailed, command_.file + ": was not sent");
    }
    return call("programs.finish", {{"upload", upload}}, &reply) && print(rt::services::row_of(Service::kProgramFinish), reply) ? 0 : status_;
  }

  int get() {
    std::uint64_t at = 0;
    Json modified;
    for (;;) {
      Json reply;
      std::string bytes;
      if (!call("programs.read", {{"name", command_.args["name"]}, {"begin", at}, {"bytes", kChunk}}, &reply)) return status_;
      if (at != 0 && reply["modified_ns"] != modified) return failed(kControlFailed, "the program was changed meanwhile: what was read is half of the old one");
      modified = reply["modified_ns"];
      if (at == 0 && !open_output()) return status_;
      if (!rt::services::from_base64(reply.value("data", ""), &bytes)) return failed(kControlFailed, "the control sends what are no bytes");
      at += bytes.size();
      if (!write_out(bytes)) return status_;
      if (bytes.empty() || at >= reply.value("size", std::uint64_t{0})) return close_output() ? 0 : status_;
    }
  }

  // ---- tables and recordings ----

  // The file of this side to write to, or standard output; false when it cannot be opened.
  bool open_output() {
    to_ = out_;
    if (command_.file.empty() || command_.file == "-") return true;
    std::string why;
    own_ = std::make_unique<WholeFile>();
    if (!own_->open(command_.file, &why)) return failed(kControlFailed, why) == 0;
    to_ = own_->stream();
    return true;
  }
  // Behind the last write: only then the file is in its place.
  bool close_output() {
    std::string why;
    return own_ == nullptr || own_->commit(&why) || failed(kControlFailed, "the output cannot be written: " + why) == 0;
  }
  bool write_out(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), to_) == text.size() && std::fflush(to_) == 0) return true;
    return failed(kControlFailed, std::string("the output cannot be written: ") + std::strerror(errno)) == 0;
  }
  static std::string json_line(const Json& json) { return json_text(json) + "\n"; }

  int export_tables() {
    Json reply;
    if (!call(command_.service, command_.args, &reply) || !open_output()) return status_;
    const Json toml = reply.value("toml", Json());
    if (!toml.is_string()) return failed(kControlFailed, "the control sends what is no text");
    return write_out(command_.json ? json_line(reply) : toml.get<std::string>()) && close_output() ? 0 : status_;
  }

  // The whole file of this side, or standard input. False when it cannot be sent.
  bool read_text(std::size_t most, std::string* text) {
    const bool named = command_.file != "-";
    const File file(named ? std::fopen(command_.file.c_str(), "rbe") : nullptr);
    if (named && file == nullptr) return failed(kControlUsage, command_.file + ": " + std::strerror(errno)) == 0;
    text->assign(most + 1, '\0');
    text->resize(std::fread(text->data(), 1, text->size(), named ? file.get() : in_));
    if (std::ferror(named ? file.get() : in_) != 0) return failed(kControlUsage, command_.file + ": " + std::strerror(errno)) == 0;
    if (text->size() > most) return failed(kControlUsage, command_.file + ": has more than " + std::to_string(most) + " bytes") == 0;
    return rt::valid_utf8(*text) == *text || failed(kControlUsage, command_.file + ": must be UTF-8") == 0;
  }

  int import_tables() {
    std::string text;
    Json reply;
    if (!read_text(rt::services::kMostToml, &text) || !call(command_.service, {{"toml", text}}, &reply)) return status_;
    return print(*rt::services::find_service(command_.service), reply) ? 0 : status_;
  }

  int swap_ladder() {
    Json args = command_.args, reply;
    const std::string name = command_.file.substr(command_.file.rfind('/') + 1);
    if (!args.contains("name") && rt::services::is_program_name(name) && name != "-") args["name"] = name;
    std::string text;
    if (!read_text(rt::services::kMostLadder, &text)) return status_;
    args["program"] = std::move(text);
    if (!call("ladder.swap", args, &reply)) return status_;
    return print(rt::services::row_of(Service::kLadderSwap), reply) ? 0 : status_;
  }

  // Records, waits for the end, and writes what there is. A signal ends the recording, and not only the waiting for it.
  int record() {
    Json reply, status;
    if (!open_output() || !call("trace.arm", command_.args, &reply)) return status_;
    const Json number = reply["recording"];
    for (bool stopped = false;;) {
      if (!call("trace.status", Json::object(), &status)) return status_;
      if (status["recording"] != number) return failed(kControlFailed, "another recording has taken the place of this one");
      if (status["state"] == "complete" || status["state"] == "stopped") return write_recording(status);
      if (rt::end_signal() != 0 && !stopped) {
        ServiceRefusal ended;  // it may have come to its end just now, and then there is nothing to be stopped
        (void)client_->call("trace.stop", Json::object(), &reply, &ended);
        stopped = true;
        continue;
      }
      std::this_thread::sleep_for(kLookPeriod);
    }
  }

  int save() {
    Json status;
    if (!call("trace.status", Json::object(), &status)) return status_;
    if (status["state"] == "none") return failed(kControlRefused, "nothing has been recorded");
    return open_output() ? write_recording(status) : status_;
  }

  int write_recording(const Json& status) {
    Json whole = {{"signals", status.value("signals", Json::array())}, {"rows", Json::array()}};
    if (!command_.json && !write_out(trace_csv_head(status))) return status_;
    for (std::uint64_t from = 0;;) {
      Json page;
      if (!call("trace.read", {{"recording", status["recording"]}, {"from", from}}, &page)) return status_;
      from = page.value("next", std::uint64_t{0});
      if (command_.json) add_page(&whole, std::move(page));
      else if (!write_out(trace_csv_rows(page))) return status_;
      if (from == 0) break;
    }
    whole.erase("next");
    return (!command_.json || write_out(json_line(whole))) && close_output() ? 0 : status_;
  }

  // One request in a line, one reply in a line. The exit status is that of the first refusal.
  int pipe() {
    int first = 0;
    to_ = out_;
    std::string line;
    for (int c = std::fgetc(in_); rt::end_signal() == 0; c = std::fgetc(in_)) {
      if (c != '\n' && c != EOF) {
        if (line.size() <= rt::services::kMostFrameBytes) line += static_cast<char>(c);  // one more says that it is too long
        continue;
      }
      if (line.size() > rt::services::kMostFrameBytes || line.find_first_not_of(" \t\r") != std::string::npos) {
        const int status = answer(line);
        if (first == 0) first = status;
        if (status_ == kControlFailed) return status_;  // nobody gets the replies
        if (status == kControlNobody) return first;
      }
      line.clear();
      if (c == EOF) break;
    }
    return first;
  }

  // A line of pipe as a request of the socket, which numbers it: nothing in it is left out. False with the refusal, in the words of the socket.
  static bool read_line(const std::string& line, Json* request, ServiceRefusal* refusal) {
    const auto bad = [refusal](const std::string& text) {
      *refusal = {kControlUsage, "malformed", text};
      return false;
    };
    std::string why;
    if (line.size() > rt::services::kMostFrameBytes) return bad("a line has at most " + std::to_string(rt::services::kMostFrameBytes) + " bytes");
    if (!rt::services::read_json(line, request, &why)) return bad("the request " + why);
    if (!request->is_object()) return bad("the request is no object");
    for (const auto& [key, value] : request->items())
      if (key != "service" && key != "args" && key != "right") return bad("the request has no member \"" + key + "\"");
    if (!request->contains("service") || !(*request)["service"].is_string()) return bad("service must be the name of a service");
    if (request->contains("args") && !(*request)["args"].is_object()) return bad("args must be an object");
    return !request->contains("right") || may_come_with(*request, refusal);
  }

  // The right that a line names limits it. Over DDS a request goes to the topic of its service, which has no member for it: so this side looks.
  static bool may_come_with(const Json& request, ServiceRefusal* refusal) {
    const std::string name = request["right"].is_string() ? request["right"].get<std::string>() : "", service = request["service"].get<std::string>();
    const auto right = rt::services::find_right(name);
    const ServiceRow* row = rt::services::find_service(service);
    if (!request["right"].is_string()) *refusal = {kControlUsage, "malformed", "right must be the name of a right"};
    else if (!right) *refusal = {kControlUsage, "malformed", "right must be view, operate, set up or maintain"};
    else if (row == nullptr) *refusal = refusal_named("unknown service", "there is no such service");
    else if (row->right != rt::services::Right::kView && row->right != *right)
      *refusal = refusal_named("no right", service + " needs the right to " + rt::services::rights_text(*row) + ", and this request has come with that to " + name);
    else return true;
    return false;
  }

  int answer(const std::string& line) {
    Json request, reply;
    ServiceRefusal refusal;
    const Json message = read_line(line, &request, &refusal) && client_->call(request["service"], request.value("args", Json::object()), &reply, &refusal)
                             ? Json{{"ok", true}, {"reply", std::move(reply)}}
                             : Json{{"ok", false}, {"error", refusal.error}, {"text", refusal.text}};
    if (!write_out(json_line(message))) return kControlFailed;
    return message["ok"] ? 0 : refusal.status;
  }

  int document() {
    const std::string text = command_.document == "markdown" ? services_markdown() : command_.document == "man" ? services_man() : command_.document == "idl" ? services_idl() : command_.document == "python" ? services_python() : services_bash();
    std::fwrite(text.data(), 1, text.size(), out_);
    return 0;
  }

  const ControlCommand& command_;
  const OpenRemote open_remote_;
  std::FILE *in_, *out_, *err_;
  std::unique_ptr<ServiceClient> client_;
  std::unique_ptr<WholeFile> own_;  // of open_output()
  std::FILE* to_ = nullptr;
  int status_ = 0;
};

}  // namespace

void keep_standard_descriptors() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor)
    if (fcntl(descriptor, F_GETFD) < 0) (void)::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

int report_refusal(const ServiceRefusal& refusal, bool json, std::FILE* out, std::FILE* err) {
  if (!json || !print_object(refusal, out)) print_lines(refusal.text.empty() ? refusal.error : refusal.text, err);
  return refusal.status;
}

int control_command(const ControlCommand& command, OpenRemote open_remote, std::FILE* in, std::FILE* out, std::FILE* err) {
  return Command(command, open_remote, in, out, err).run();
}

}  // namespace nc::tools
