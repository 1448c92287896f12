// The program `vis2hap`: parses the command line, makes the Qt application that the command needs and runs the command. Every
// fault becomes one line and an exit code.
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QCoreApplication>
#include <chrono>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <opencv2/core.hpp>

#include "database/server/server_link.h"
#include "protocols/files/errors.h"
#include "protocols/files/open_files.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/process/blas_threads.h"
#include "protocols/process/kept_memory.h"
#include "protocols/process/owner_only.h"
#include "protocols/process/whole_number_options.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/explanation.h"
#include "study/commands/parts/safe_outputs.h"

namespace {

using protocols::ExitCode;
using study::commands::Action;
using study::commands::Surroundings;

/// Files and folders are closed to other accounts. Other programs of the same user cannot read the memory, which holds keys.
void keepToOneself()
{
    protocols::keepFilesToOwner();
    ::prctl(PR_SET_DUMPABLE, 0);
}

bool screenIsThere()
{
    return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr ||
           std::getenv("QT_QPA_PLATFORM") != nullptr;
}

/// Prints only faults. Qt also warns about pictures that its readers refuse, for which we have a message of our own, and about
/// functions that the offscreen platform lacks.
void printFaultsOnly(QtMsgType type, const QMessageLogContext&, const QString& text)
{
    if (type == QtCriticalMsg || type == QtFatalMsg) std::fprintf(stderr, "vis2hap: %s\n", qPrintable(text));
}

protocols::Error screenFault(const std::string& where)
{
    return protocols::environmentFault({"the window needs a screen", where,
                                        "DISPLAY or WAYLAND_DISPLAY to name a desktop that runs",
                                        "start the program from a desktop (Wayland alone needs Debian's package qt6-wayland), or "
                                        "use `vis2hap replay` and `vis2hap report`"});
}

/// Ends the program with the exit code of a missing screen where Qt would abort. Qt's warnings before that are left out.
void endWithoutScreen(QtMsgType type, const QMessageLogContext&, const QString&)
{
    if (type != QtFatalMsg) return;
    std::string where;
    for (const char* name : {"QT_QPA_PLATFORM", "WAYLAND_DISPLAY", "DISPLAY"})
        if (const char* value = std::getenv(name)) where += (where.empty() ? "" : ", ") + (name + ("=" + std::string(value)));
    const protocols::Error fault = screenFault(where);
    std::fprintf(stderr, "vis2hap: %s\n", fault.what());
    std::_Exit(static_cast<int>(fault.exitCode()));
}

std::unique_ptr<QCoreApplication> surroundingsFor(Surroundings kind, int& argc, char** argv)
{
    qInstallMessageHandler(printFaultsOnly);
    if (kind == Surroundings::None) return nullptr;
    if (kind == Surroundings::Core) return std::make_unique<QCoreApplication>(argc, argv);
    if (kind == Surroundings::Window && !screenIsThere()) throw screenFault("");
    const bool isSeen = kind != Surroundings::Offscreen && screenIsThere();
    if (kind == Surroundings::Offscreen) qputenv("QT_QPA_PLATFORM", "offscreen");  // the named desktop may be gone
    if (!isSeen && std::getenv("QT_QPA_PLATFORM") == nullptr) qputenv("QT_QPA_PLATFORM", "offscreen");
    qInstallMessageHandler(endWithoutScreen);
    QGuiApplication::setDesktopFileName(QStringLiteral("vis2hap"));  // Wayland finds the icon of the window by it
    auto application = std::make_unique<QApplication>(argc, argv);
    qInstallMessageHandler(isSeen ? nullptr : printFaultsOnly);
    return application;
}

/// Qt's own application, which stays where a connection to a server has not ended: with it Qt would take down the driver that the
/// thread of the connection still uses.
struct Application {
    std::unique_ptr<QCoreApplication> made;

    ~Application()
    {
        if (!database::haveLinksEnded(std::chrono::seconds(1))) (void)made.release();
    }
};

/// Qt's event loop and tar end without a message of ours below this number of open files.
constexpr rlim_t fewestOpenFiles = 16;

void requireOpenFiles()
{
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < fewestOpenFiles) throw protocols::tooManyOpenFiles("vis2hap");
}

/// A file that a command opens must not get the number of a stream that the caller closed: what is printed would go into it.
void openClosedStreams()
{
    for (int stream = 0; stream <= 2; ++stream)
        if (::fcntl(stream, F_GETFD) == -1) (void)::open("/dev/null", O_RDONLY);  // the lowest free number; writing fails
}

void requireWrittenOutput()
{
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return;
    throw protocols::environmentFault({"the output cannot be written", "standard output",
                                       "a terminal, a pipe or a disk with room", "write into a file on another disk"});
}

int run(int argc, char** argv)
{
    CLI::App app("Blinded, randomized haptic-rendering studies: touch from vision.", "vis2hap");
    app.set_version_flag("--version", study::commands::versionText());
    app.require_subcommand(0, 1);
    app.get_formatter()->column_width(28);
    Action action;
    study::commands::addApp(app, action);
    study::commands::addFabrics(app, action);
    study::commands::addImport(app, action);
    study::commands::addCalibrate(app, action);
    study::commands::addHeight(app, action);
    study::commands::addTrain(app, action);
    study::commands::addEvaluate(app, action);
    study::commands::addRender(app, action);
    study::commands::addStudy(app, action);
    study::commands::addReplay(app, action);
    study::commands::addSimulate(app, action);
    study::commands::addReport(app, action);
    study::commands::addExport(app, action);
    study::commands::addUnblind(app, action);
    study::commands::addVerify(app, action);
    study::commands::addLeakCheck(app, action);
    study::commands::addErase(app, action);
    study::commands::addBackup(app, action);
    study::commands::addRescue(app, action);
    study::commands::addNumbers(app, action);
    study::commands::addAnalyse(app, action);
    study::commands::addPower(app, action);
    study::commands::addProtocol(app, action);
    study::commands::addMerge(app, action);
    study::commands::addBench(app, action);
    study::commands::addDisplay(app, action);
    study::commands::addStroke(app, action);
    study::commands::addView(app, action);
    study::commands::addServer(app, action);
    study::commands::Explanation explanation;
    explanation.addOptions(app);
    try {
        protocols::requirePlainWholeNumbers(app);
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        if (problem.get_exit_code() == 0) {  // help and version
            (void)app.exit(problem);
            std::cout.flush();
            requireWrittenOutput();
            return 0;
        }
        const auto called = app.get_subcommands();
        const std::string command = called.empty() ? "" : called.front()->get_name() + " ";
        std::fprintf(stderr, "vis2hap: %s; see `vis2hap %s--help`\n", protocols::printable(problem.what()).c_str(),
                     command.c_str());
        return static_cast<int>(ExitCode::BadInput);
    }
    requireOpenFiles();
    study::commands::requireFilledArguments(app);
    study::commands::requireSafeOutputs(app);
    // Qt gets no options, because it would read ours: to Qt, --display names a screen of the X server.
    int programNameAlone = 1;
    const Application application{surroundingsFor(action.surroundings, programNameAlone, argv)};
    std::setlocale(LC_NUMERIC, "C");  // Qt has set the user's locale, in which C functions may read 5.4 as 5
    if (action.handlesStudy) keepToOneself();
    protocols::keepFreedMemory();
    protocols::useOneBlasThread();
    explanation.begin(app);
    const int code = action.work();
    explanation.end();
    requireWrittenOutput();
    return code;
}

/// A folder or file of which the file system refuses something.
protocols::Error faultOf(const std::filesystem::filesystem_error& error)
{
    const std::string where = error.path2().empty() ? error.path1().string() : error.path2().string();
    if (protocols::isTooManyOpenFiles(error.code().value())) return protocols::tooManyOpenFiles(where);
    return protocols::environmentFault({"the file system refuses it (" + error.code().message() + ")", where,
                                        "files and folders that this account may read and write",
                                        "check the path, its permissions and the free space"});
}

int failedForMemory()
{
    std::fputs("vis2hap: the memory is used up; close other programs or use smaller input\n", stderr);
    return static_cast<int>(ExitCode::Environment);
}

int failedUnexpectedly(const std::exception& error)
{
    std::fprintf(stderr, "vis2hap: unexpected failure: %s; report it with the command that you ran\n",
                 protocols::printable(error.what()).c_str());
    return static_cast<int>(ExitCode::WorkFailed);
}

int exitCodeOf(int argc, char** argv)
{
    try {
        return run(argc, argv);
    } catch (const protocols::Error& error) {
        std::fprintf(stderr, "vis2hap: %s\n", error.what());
        return static_cast<int>(error.exitCode());
    } catch (const std::filesystem::filesystem_error& error) {
        const protocols::Error fault = faultOf(error);
        std::fprintf(stderr, "vis2hap: %s\n", fault.what());
        return static_cast<int>(fault.exitCode());
    } catch (const std::bad_alloc&) {
        return failedForMemory();
    } catch (const cv::Exception& error) {
        return error.code == cv::Error::StsNoMem ? failedForMemory() : failedUnexpectedly(error);
    } catch (const std::exception& error) {
        return failedUnexpectedly(error);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    openClosedStreams();
    std::signal(SIGCHLD, SIG_DFL);  // a parent that ignores it would hide the ends of other programs
    std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is an error of the write
    const int code = exitCodeOf(argc, argv);
    protocols::removeLivingFolders();
    if (!QCoreApplication::instance() && database::haveLinksEnded(std::chrono::seconds(0))) return code;
    std::cout.flush();
    std::fflush(nullptr);
    std::_Exit(code);  // static objects would be destroyed under a thread that still waits for a server
}
