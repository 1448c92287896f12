// A process of its own for tests that kill one, or need a second writer or another user:
//   session_child play STUDY PARTICIPANT    plays to the end; a line for each acknowledged answer
//   session_child hold STUDY                opens for writing, says "held", waits to be killed
//   session_child look STUDY                as nobody (where it may): "read N" answers, then "write MESSAGE"
#include <unistd.h>

#include <QCoreApplication>
#include <iostream>
#include <string>

#include "protocols/files/errors.h"
#include "tests/support/played_session.h"

using namespace tests::support;

namespace {

constexpr uid_t nobody = 65534;

void say(const std::string& line)
{
    const std::string text = line + "\n";
    [[maybe_unused]] const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
}

void play(const database::StudyFolder& folder, const std::string& participant)
{
    OpenSession session(folder, participant);
    int told = session.driver->state().answersStored;
    say("open " + std::to_string(told));
    while (session.step())
        for (; told < session.driver->state().answersStored; ++told) say("answer " + std::to_string(told + 1));
    say("end");
}

void hold(const database::StudyFolder& folder)
{
    const database::StudyStore store(folder, database::StudyStore::Access::Write);
    say("held");
    while (true) ::pause();
}

void look(const database::StudyFolder& folder)
{
    if (::geteuid() == 0 && ::setuid(nobody) != 0) say("still root");
    const database::StudyStore store(folder, database::StudyStore::Access::Read);
    say("read " + std::to_string(store.answers().size()) + " synchronous " + std::to_string(store.synchronousMode()));
    try {
        const database::StudyStore writer(folder, database::StudyStore::Access::Write);
        say("write possible");
    } catch (const protocols::Error& fault) {
        say("write exit " + std::to_string(static_cast<int>(fault.exitCode())) + " " + fault.what());
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
        say(std::string("fault ") + fault.what());
        return 1;
    }
    return 0;
}
