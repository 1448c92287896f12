// A training run that is killed forty times while it writes its checkpoint.
#include <QElapsedTimer>
#include <QFile>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <QThread>
#include <filesystem>

#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/models/process/child_process.h"

using namespace rendering;

class CheckpointTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;

    QString text(const char* name) const { return m_folder.filePath(name); }

    QStringList endlessRun() const
    {
        return {"train",
                text("fabrics"),
                "--out",
                text("model.safetensors"),
                "--steps",
                "1000000",
                "--crop",
                "32",
                "--channels",
                "2",
                "--batch",
                "2",
                "--checkpoint-every",
                "1",
                "--validate-every",
                "1000000",
                "--validation-pairs",
                "2",
                "--threads",
                "1"};
    }

    /// Names of checkpoints that are being written, or were when the run was killed.
    QStringList unfinished() const
    {
        return QDir(m_folder.path()).entryList({".model.safetensors.checkpoint.unfinished-*"}, QDir::Files | QDir::Hidden);
    }

    /// Kills the run `delayUs` microseconds after it began to write its first checkpoint; returns its output.
    QString killedWhileWriting(bool resume, int delayUs) const
    {
        QProcess run;
        run.start(QString::fromStdString(models::generatorProgram().string()),
                  resume ? endlessRun() << "--resume" : endlessRun());
        QElapsedTimer waited;
        waited.start();
        while (unfinished().isEmpty() && waited.elapsed() < 60000 && run.state() != QProcess::NotRunning) run.waitForReadyRead(0);
        QThread::usleep(static_cast<unsigned long>(delayUs));
        run.kill();
        run.waitForFinished();
        return run.readAllStandardOutput() + run.readAllStandardError();
    }

private Q_SLOTS:
    void initTestCase()
    {
        for (const auto& [name, value] : models::missingThreadSettings()) qputenv(name.c_str(), QByteArray::fromStdString(value));
        fabrics::ProceduralOptions options;
        options.fabrics = 1;
        options.samples = 4;
        options.seed = 32;
        fabrics::makeProceduralFabrics(text("fabrics").toStdString(), options);
    }

    void checkpointLoadsAfterKillsDuringItsWriting()
    {
        constexpr int kills = 20;
        static const QRegularExpression resumed("resumed at step (\\d+)");
        killedWhileWriting(false, 300000);
        for (const QString& file : unfinished()) QFile::remove(m_folder.filePath(file));
        QVERIFY(QFile::exists(text("model.safetensors") + ".checkpoint"));
        int last = 0, interrupted = 0;
        for (int i = 0; i < kills; ++i) {
            const QString output = killedWhileWriting(true, i * 75);
            const QRegularExpressionMatch match = resumed.match(output);
            QVERIFY2(match.hasMatch(), qPrintable(QString("kill %1: %2").arg(i).arg(output)));
            QVERIFY(match.captured(1).toInt() >= last);
            last = match.captured(1).toInt();
            for (const QString& file : unfinished()) {
                ++interrupted;
                QFile::remove(m_folder.filePath(file));
            }
        }
        // Some kills came after a whole checkpoint. How many depends on the load of the machine.
        QVERIFY2(last > 2, qPrintable(QString::number(last)));
        QVERIFY2(interrupted > kills / 4,
                 qPrintable(QString("%1 of %2 kills fell into the writing").arg(interrupted).arg(kills)));
    }
};

QTEST_GUILESS_MAIN(CheckpointTest)
#include "checkpoint_test.moc"
