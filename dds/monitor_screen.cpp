// SPDX-License-Identifier: Apache-2.0
// See monitor_screen.hpp.
#include "dds/monitor_screen.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace nc::dds {

std::string from_line(const std::string& page, std::size_t* line) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < *line && at < page.size(); ++i) at = std::min(page.find('\n', at), page.size() - 1) + 1;
  if (at >= page.size()) at = *line = 0;
  return page.substr(at);
}

std::string fitted(const std::string& page, unsigned rows, unsigned columns) {
  std::string text = "\033[H";
  unsigned row = 0;
  for (std::size_t begin = 0; begin < page.size() && row + 1 < rows; ++row) {
    const std::size_t end = page.find('\n', begin);
    std::string line = page.substr(begin, end - begin);
    if (line.size() > columns) line.resize(columns);
    text += line + "\033[K\r\n";
    begin = end == std::string::npos ? page.size() : end + 1;
  }
  return text + "\033[J";
}

Screen::Screen() {
  raw_ = tcgetattr(STDIN_FILENO, &before_) == 0;
  if (raw_) {
    termios now = before_;
    now.c_lflag &= static_cast<tcflag_t>(~(ICANON | ECHO));
    tcsetattr(STDIN_FILENO, TCSANOW, &now);
  }
  std::fputs("\033[?1049h\033[?25l", stdout);
}

Screen::~Screen() {
  std::fputs("\033[?25h\033[?1049l", stdout);
  std::fflush(stdout);
  if (raw_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

winsize Screen::dimensions() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0) size = {24, 80, 0, 0};
  return size;
}

void Screen::show(const std::string& page) {
  const winsize size = dimensions();
  std::fputs(fitted(page, size.ws_row, size.ws_col).c_str(), stdout);
  std::fflush(stdout);
}

char Screen::key() const {
  pollfd in{STDIN_FILENO, POLLIN, 0};
  char key = 0;
  return raw_ && poll(&in, 1, 0) > 0 && read(STDIN_FILENO, &key, 1) == 1 ? key : '\0';
}

}  // namespace nc::dds
