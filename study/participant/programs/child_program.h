// What the programs beside the app share: they end with the app, read its lines from standard input, and report faults.
#pragma once

#include <QSocketNotifier>
#include <exception>
#include <functional>
#include <string>

#include "study/participant/page_lines.h"

namespace study::participant {

/// Ends this program with its parent, closes files that a parent of the app left open, and ignores closed pipes.
void becomeChildProgram();

/// Writes "PROGRAM: fault" to standard error. Returns `code`.
int reported(const std::string& program, const std::exception& fault, int code);

/// Gives every line of standard input to `take`. Ends the program with the input (code 0), and with a reported fault (code 1) at
/// a line for which `take` throws protocols::Error.
class InputLines {
public:
    InputLines(std::string program, std::function<void(const std::string&)> take);

private:
    void read();

    std::string m_program;
    std::function<void(const std::string&)> m_take;
    LineBuffer m_lines;
    QSocketNotifier m_notifier;
};

}  // namespace study::participant
