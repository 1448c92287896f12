#include "study/commands/parts/script_check.h"

#include <QProcess>
#include <QProcessEnvironment>
#include <QStandardPaths>
#include <cstdio>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/secrets/secret_variables.h"
#include "reports/scripts/reproduction.h"

namespace study::commands {

namespace {

constexpr int longestMs = 10 * 60 * 1000;

struct ScriptLanguage {
    const char* program;
    const char* script;
    const char* package;
};

}  // namespace

void checkReport(const std::filesystem::path& report, const std::string& language)
{
    const ScriptLanguage asked = language == "R" ? ScriptLanguage{"Rscript", "analysis.R", "r-base-core"}
                                                 : ScriptLanguage{"python3", "analysis.py", "python3-scipy"};
    const auto folder = report / reports::reproductionFolder;
    if (!std::filesystem::exists(folder / asked.script))
        throw protocols::badInput({"this report has no scripts, because the study is blinded", report.string(),
                                   "a study that is unblinded, or --from ANSWERS.csv", "report again after the unblinding"});
    if (QStandardPaths::findExecutable(asked.program).isEmpty()) {
        std::printf("not checked: %s is not installed (apt-get install %s)\n", asked.program, asked.package);
        return;
    }
    QProcess process;
    process.setWorkingDirectory(QString::fromStdString(folder.string()));
    process.setProcessEnvironment(protocols::withoutSecrets(QProcessEnvironment::systemEnvironment()));
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(asked.program, {asked.script});
    const bool hasEnded = process.waitForFinished(longestMs);
    if (!hasEnded) {
        process.kill();
        process.waitForFinished();
    }
    const QString said = QString::fromUtf8(process.readAll()).trimmed();
    for (const QString& line : said.split('\n'))
        std::printf("%s: %s\n", asked.script, protocols::printable(line.toStdString()).c_str());
    if (!hasEnded || process.exitStatus() != QProcess::NormalExit || process.exitCode() != 0)
        throw protocols::workFailed({std::string(asked.script) + " did not reproduce the report", folder.string(), "",
                                     "its lines above say which numbers differ, or what it lacks"});
}

}  // namespace study::commands
