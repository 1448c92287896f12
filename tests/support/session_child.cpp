// Child process for tests that kill a process, or need a second writer or another user:
//   session_child play STUDY PARTICIPANT    plays to the end and prints a line for each stored answer
//   session_child hold STUDY                opens the study for writing, prints "held" and waits to be killed
//   session_child look STUDY                as user nobody, if possible: prints "read N …" for N answers, then "write MESSAGE"
#include <unistd.h>

#include <QCoreApplication>
#include <iostream>
#include <string>

#include "database/sqlite_connection.h"
#include "protocols/files/errors.h"
#include "tests/support/server/engine_session.h"

using namespace tests::support;

namespace {

constexpr uid_t nobody = 65534;

void print(const std::string& line)
{
    const std::string text = line + "\n";
    [[maybe_unused]] const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
}

void play(const database::StudyFolder& folder, const std::string& participant)
{
    EngineSession session(folder, participant);
    int printed = session.driver->state().answersStored;
    print("open " + std::to_string(printed));
    while (session.step())
        for (; printed < session.driver->state().answersStored; ++printed) print("answer " + std::to_string(printed + 1));
    print("end");
}

void hold(const database::StudyFolder& folder)
{
    const database::StudyStore store(folder, database::StudyStore::Access::Write);
    print("held");
    while (true) ::pause();
}

void look(const database::StudyFolder& folder)
{
    if (::geteuid() == 0 && ::setuid(nobody) != 0) print("still root");
    const database::StudyStore store(folder, database::StudyStore::Access::Read);
    const int synchronous = store.connection().value("PRAGMA synchronous").toInt();
    print("read " + std::to_string(store.answers().size()) + " synchronous " + std::to_string(synchronous));
    try {
        const database::StudyStore writer(folder, database::StudyStore::Access::Write);
        print("write possible");
    } catch (const protocols::Error& fault) {
        print("write exit " + std::to_string(static_cast<int>(fault.exitCode())) + " " + fault.what());
    }
}

}  // namespace

int main(int argc, char** argv)
{
    const QCoreApplication application(argc, argv);
    const std::string mode = argc > 2 ? argv[1] : "";
    try {
        if (mode == "play" && argc > 3)
            play({argv[2]}, argv[3]);
        else if (mode == "hold")
            hold({argv[2]});
        else if (mode == "look")
            look({argv[2]});
    } catch (const std::exception& fault) {
        print(std::string("fault ") + fault.what());
        return 1;
    }
    return 0;
}
