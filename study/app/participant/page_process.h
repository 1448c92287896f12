// vis2hap-page as a child process: started with an address, fed with lines, read line by line. It gets an empty environment and
// no folder of the study, and it ends with this program. What it writes comes from a network, so nothing in it is trusted.
#pragma once

#include <QObject>
#include <QProcess>
#include <memory>

#include "study/participant/page_lines.h"

namespace study::app {

class PageProcess : public QObject {
    Q_OBJECT
public:
    explicit PageProcess(QObject* parent);
    ~PageProcess() override;

    /// Starts the program; it reports its port by lineRead(). `port`: wanted, 0 for any. Throws environmentFault where the
    /// program is missing.
    void start(const QString& address, int port);
    void stop();
    bool isRunning() const { return m_process != nullptr; }
    /// 0 while the program does not run.
    qint64 processId() const { return m_process ? m_process->processId() : 0; }
    void send(const participant::LineToPage& line);

Q_SIGNALS:
    void lineRead(const study::participant::LineFromPage& line);
    /// The program ended although nobody stopped it. `why`: its last words, or what the system reports.
    void ended(const QString& why);

private:
    void read();
    void end(const QString& why);

    struct Later {
        void operator()(QProcess* process) const { process->deleteLater(); }
    };
    std::unique_ptr<QProcess, Later> m_process;  ///< empty while the program does not run
    participant::LineBuffer m_lines;
};

/// The program beside this one or one folder above (tests); the environment variable VIS2HAP_PAGE replaces it. Throws
/// environmentFault where there is none.
QString pageProgram();

}  // namespace study::app
