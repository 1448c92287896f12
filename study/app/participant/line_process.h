// A helper program as a child process: started with arguments, fed with lines, read line by line. It ends with this program. What
// it writes may come from a network, so nothing in it is trusted.
#pragma once

#include <QObject>
#include <QProcess>
#include <memory>

#include "study/participant/page_lines.h"

namespace study::app {

/// Whether the program sees the surroundings of this one without its secrets (sound needs the user's sound server), or none (a
/// page that others can reach).
enum class ProgramSurroundings { Own, None };

class LineProcess : public QObject {
    Q_OBJECT
public:
    explicit LineProcess(QObject* parent);
    ~LineProcess() override;

    /// Starts the program of this name beside this one, or one folder above (tests). Throws environmentFault where it is missing;
    /// other faults come by ended().
    void start(const QString& name, const QStringList& arguments, ProgramSurroundings surroundings);
    void stop();
    /// Stops a program that wrote something senseless, and reports it as ended.
    void fail(const QString& why);
    bool isRunning() const { return m_process != nullptr; }
    /// 0 while the program does not run.
    qint64 processId() const { return m_process ? m_process->processId() : 0; }
    /// Sends a line, without its end. Does nothing while the program does not run.
    void send(const std::string& line);

Q_SIGNALS:
    void lineRead(const std::string& line);
    /// The program ended although nobody stopped it. `why`: its last words, or what the system reports.
    void ended(const QString& why);

private:
    void read();
    void end(const QString& why);
    void keepErrors();

    struct Later {
        void operator()(QProcess* process) const { process->deleteLater(); }
    };
    std::unique_ptr<QProcess, Later> m_process;  ///< empty while the program does not run
    participant::LineBuffer m_lines;
    QByteArray m_errors;  ///< the end of its error text
};

}  // namespace study::app
