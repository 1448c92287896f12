// Work that is shared between machines: shards of a run, merged, print what the run in one process prints, byte for byte.
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>
#include <QTest>
#include <cstring>
#include <nlohmann/json.hpp>

#include "protocols/files/sha256.h"
#include "tests/support/program.h"

using nlohmann::json;

class MergeCommandTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    QString m_protocol;

    QString at(const QString& name) const { return m_folder.filePath(name); }

    static QByteArray bytesOf(const QString& file)
    {
        QFile opened(file);
        return opened.open(QIODevice::ReadOnly) ? opened.readAll() : QByteArray();
    }

    static void write(const QString& file, const QByteArray& bytes)
    {
        QFile out(file);
        QVERIFY(out.open(QIODevice::WriteOnly));
        out.write(bytes);
    }

    /// Runs all shards of a command and returns their files.
    QStringList shardsOf(const QStringList& call, int parts, const QString& name) const
    {
        QStringList files;
        for (int part = 1; part <= parts; ++part) {
            files.append(at(QString("%1-%2").arg(name).arg(part)));
            support::mustRun(call + QStringList{"--shard", QString("%1/%2").arg(part).arg(parts), "--shard-file", files.last()});
        }
        return files;
    }

    /// Writes the shard with other content and the hash of that, as somebody may who knows the format.
    template <class Change>
    void forge(const QString& from, const QString& to, Change change) const
    {
        json shard = json::parse(bytesOf(from).toStdString());
        change(shard);
        shard.erase("sha256");
        shard["sha256"] = protocols::sha256(shard.dump());
        write(to, QByteArray::fromStdString(shard.dump()));
    }

    static void isRefused(const QStringList& call, const char* what)
    {
        const auto ended = support::runProgram(call);
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.messages().size() == 1 && ended.err.contains(what), qPrintable(ended.err));
    }

    /// Merges the shards without the answers to pairs that differed under the first condition, then as an earlier version wrote
    /// them.
    void unevenPairsAreNotTested(const QStringList& files) const
    {
        const auto mergedWith = [&](const auto& change) {
            QStringList forged;
            for (const QString& file : files) {
                forged.append(file + "-changed");
                forge(file, forged.last(), [&](json& shard) {
                    for (json& one : shard["values"]["answers"]) change(one);
                });
            }
            support::mustRun(QStringList{"merge"} + forged + QStringList{"--out", at("changed")});
            return json::parse(bytesOf(at("changed/results.json")).toStdString())["questions"]["S1"];
        };
        const json uneven = mergedWith([](json& one) {
            auto &values = one["values"].get_ref<std::string&>(), &wasSame = one["was_same"].get_ref<std::string&>();
            for (std::size_t i = 18; i < 18 + 3; ++i) {  // behind 9 choices and 9 ratings
                if (wasSame.substr(2 * i, 2) != "00") continue;
                values.replace(4 * i, 4, "0080");
                wasSame.replace(2 * i, 2, "ff");
            }
        });
        QVERIFY(uneven["v_grey"]["p_chance"].is_null() && uneven["v_grey"]["p_chance_participants"].is_null());
        QVERIFY(QString::fromStdString(uneven["v_grey"]["why"]["p_chance"].get<std::string>()).contains("pairs were the same"));
        QVERIFY(uneven["f"]["p_chance"].is_number());
        const json earlier = mergedWith([](json& one) { one.erase("was_same"); });
        QVERIFY(earlier["v_grey"]["p_chance"].is_number());
    }

private Q_SLOTS:
    void initTestCase()
    {
        m_protocol = at("small.json");
        write(m_protocol,
              "{\"schema\":\"vis2hap.protocol/1\",\"name\":\"Small\",\"participants\":4,\"fabrics\":3,"
              "\"conditions\":[\"v_grey\",\"f\",\"h\"],\"phases\":[{\"questions\":[\"Q1\"],\"alternatives\":3},"
              "{\"questions\":[\"Q2\"],\"scale\":{\"min\":0,\"max\":10,\"step\":0.5,\"sections\":9}}]}");
    }

    void powerCalibrationAndPlantedStudiesMerge()
    {
        const QStringList call{"power", "--protocol",  m_protocol, "--studies", "40", "--seed",
                               "3",     "--calibrate", "100",      "--planted", "100"};
        const QStringList files = shardsOf(call, 3, "power");
        QFile::remove(m_protocol);  // Shards hold the protocol, so that any machine can merge them.
        const QString merged = support::mustRun(QStringList{"merge"} + files).out;
        initTestCase();
        QCOMPARE(support::mustRun(call).out, merged);
        support::mustRun(call + QStringList{"--json", at("one.json")});
        const QStringList reversed(files.rbegin(), files.rend());
        support::mustRun(QStringList{"merge"} + reversed + QStringList{"--json", at("merged.json")});
        QVERIFY(bytesOf(at("one.json")).size() > 1000);
        QCOMPARE(bytesOf(at("merged.json")), bytesOf(at("one.json")));
        // No share of the work is all of it: the counts are really summed.
        const json first = json::parse(bytesOf(files[0]).toStdString());
        const auto& planned = first["values"]["planned"];
        QVERIFY(!planned.empty());
        QCOMPARE(planned.begin().value()[0][0].get<int>(), 14);  // studies 1, 4, 7, … of 40
    }

    void aShardContinuesWhereItWasInterrupted()
    {
        const QStringList call{"power",   "--protocol", m_protocol, "--studies",  "20",           "--calibrate", "100",
                               "--shard", "2/2",        "--resume", at("counts"), "--shard-file", at("resumed")};
        support::mustRun(call);
        const QByteArray first = bytesOf(at("resumed"));
        support::mustRun(call);
        QCOMPARE(bytesOf(at("resumed")), first);
        // Counts of another shard are not taken for those of this one.
        QStringList other = call;
        other.replaceInStrings("2/2", "1/2");
        QCOMPARE(support::runProgram(other).exitCode, 2);
    }

    void shardsThatAreNotOneRunAreRefused()
    {
        const QStringList call{"power", "--protocol", m_protocol, "--studies", "20"};
        const QStringList files = shardsOf(call, 3, "run");
        const auto refused = [](const QStringList& named, const char* what) {
            const auto ended = support::runProgram(QStringList{"merge"} + named);
            QCOMPARE(ended.exitCode, 2);
            QVERIFY2(ended.messages().size() == 1 && ended.err.contains(what), qPrintable(ended.err));
            QVERIFY(ended.out.isEmpty());
        };
        refused({files[0], files[2]}, "shard 2 of 3 is missing");
        refused(files + QStringList{files[1]}, "shard 2/3 occurs twice");
        const QStringList others = shardsOf(call + QStringList{"--seed", "2"}, 3, "other");
        refused({files[0], others[1], files[2]}, "another \"seed\"");
        QByteArray altered = bytesOf(files[1]);
        altered.replace("\"planned\"", "\"planed\"");
        write(at("altered"), altered);
        refused({files[0], at("altered"), files[2]}, "damaged or was altered");
        refused({m_protocol}, "the file is no shard");
        refused({at("nowhere")}, "nowhere");
        // A JSON file that nobody could have wanted is not written.
        QCOMPARE(support::runProgram({"merge", files[0], files[1], "--json", at("none.json")}).exitCode, 2);
        QVERIFY(!QFile::exists(at("none.json")));
    }

    void wrongCallsEndWithTwo()
    {
        const QStringList call{"power", "--studies", "20"};
        for (const char* shard : {"0/2", "3/2", "two", "1/"})
            QCOMPARE(support::runProgram(call + QStringList{"--shard", shard}).exitCode, 2);
        QCOMPARE(support::runProgram(call + QStringList{"--shard", "1/2", "--json"}).exitCode, 2);
        QCOMPARE(support::runProgram(call + QStringList{"--shard-file", at("alone")}).exitCode, 2);
        QCOMPARE(support::runProgram({"merge"}).exitCode, 2);
        QCOMPARE(support::runProgram({"train", m_folder.path(), "--out", at("m"), "--shard", "1/2"}).exitCode, 2);
        QCOMPARE(support::runProgram({"train", "--drawn", "--out", at("m"), "--steps", "1", "--leave-one-out"}).exitCode, 2);
    }

    void simulatedParticipantsMerge()
    {
        support::mustRun({"fabrics", "make", at("cloth"), "--fabrics", "3", "--samples", "10", "--seed", "4"});
        json protocol = json::parse(bytesOf(m_protocol).toStdString());
        protocol["phases"].push_back({{"questions", {"S1"}}, {"same_different", true}});
        protocol["question_texts"]["S1"] = "Do you see what you touch?";
        write(at("pairs.json"), QByteArray::fromStdString(protocol.dump()));
        support::mustRun({"study", "new", at("study"), "--dataset", at("cloth"), "--protocol", at("pairs.json"), "--seed", "1",
                          "--no-passphrase"});
        // More participants than places, and some of them withdraw.
        const QStringList call{"simulate", at("study"), "--in-memory", "--participants", "31", "--seed", "6", "--mishaps"};
        const QString one = support::mustRun(call + QStringList{"--out", at("whole")}).out;
        const QStringList files = shardsOf(call, 4, "simulated");
        QDir().rename(at("study"), at("elsewhere"));  // Shards can be merged where no study is.
        const QString merged = support::mustRun(QStringList{"merge"} + files + QStringList{"--out", at("merged")}).out;
        QDir().rename(at("elsewhere"), at("study"));
        QCOMPARE(QString(merged).replace(at("merged"), at("whole")), one);
        QStringList tables = QDir(at("whole/tables")).entryList(QDir::Files);
        QVERIFY(tables.size() > 5);
        QCOMPARE(QDir(at("merged/tables")).entryList(QDir::Files), tables);
        for (const QString& table : tables) QCOMPARE(bytesOf(at("merged/tables/" + table)), bytesOf(at("whole/tables/" + table)));
        QVERIFY(bytesOf(at("whole/results.json")).size() > 1000);
        QCOMPARE(bytesOf(at("merged/results.json")), bytesOf(at("whole/results.json")));
        // No code of the study stands in a shard.
        for (const auto& stimulus : QDir(at("study/stimuli")).entryInfoList(QDir::Files))
            QVERIFY(!bytesOf(files[0]).contains(stimulus.completeBaseName().toUtf8()));
        QCOMPARE(support::runProgram({"simulate", at("study"), "--shard", "1/2"}).exitCode, 2);
        QCOMPARE(support::runProgram(call + QStringList{"--out", at("no"), "--shard", "1/2"}).exitCode, 2);
        QCOMPARE(support::runProgram(QStringList{"merge"} + files).exitCode, 2);
        QVERIFY(!QFile::exists(at("no")));

        // Little-endian numbers: a rating beyond the scale, a choice that is neither right nor wrong, times that are none.
        const auto damaged = [&](const char* field, std::size_t digit, const char* hex) {
            forge(files[0], at("forged"), [&](json& shard) {
                shard["values"]["answers"][0][field].get_ref<std::string&>().replace(digit, std::strlen(hex), hex);
            });
            isRefused(QStringList{"merge", at("forged")} + files.mid(1) + QStringList{"--out", at("no")},
                      "answers of the shard are damaged");
        };
        damaged("values", 0, "0700");
        damaged("values", 4 * 9, "fc7f");  // the first rating, behind 9 choices
        damaged("seconds", 0, "000000000000f07f");
        damaged("seconds", 0, "00000000000014c0");
        damaged("was_same", 0, "00");  // of a choice among three
        damaged("was_same", 2 * 18, "02");
        unevenPairsAreNotTested(files);
        forge(files[0], at("same"), [](json&) {});
        support::mustRun(QStringList{"merge", at("same")} + files.mid(1) + QStringList{"--out", at("forged-out")});
    }

    void trainingsWithoutEachFabricMerge()
    {
        support::mustRun({"fabrics", "make", at("fabrics"), "--fabrics", "2", "--samples", "10", "--seed", "2"});
        const auto call = [&](const char* out) {
            return QStringList{"train",
                               at("fabrics"),
                               "--leave-one-out",
                               "--out",
                               at(out),
                               "--steps",
                               "2",
                               "--crop",
                               "48",
                               "--channels",
                               "4",
                               "--batch",
                               "2",
                               "--threads",
                               "1",
                               "--validation-pairs",
                               "2"};
        };
        const auto one = support::mustRun(call("whole"));
        QVERIFY(one.out.contains("each fabric tested by a model that was trained without it"));
        QStringList files;
        for (const char* part : {"1", "2", "3"}) {  // The third one has nothing to do.
            files.append(at(QString("left-out-") + part));
            support::mustRun(call("shared") + QStringList{"--shard", QString(part) + "/3", "--shard-file", files.last()});
        }
        QCOMPARE(support::mustRun(QStringList{"merge"} + files).out, one.out);
        QStringList forged;
        for (const QString& file : files) {
            forged.append(file + "-forged");
            forge(file, forged.last(), [](json& shard) { shard["options"]["fabrics"] = {"F01", "F01"}; });
        }
        isRefused(QStringList{"merge"} + forged, "do not hold every fabric");
        for (const char* fabric : {"F01", "F02"}) {
            const QByteArray weights = bytesOf(at(QString("whole/%1.safetensors").arg(fabric)));
            QVERIFY(!weights.isEmpty());
            QCOMPARE(bytesOf(at(QString("shared/%1.safetensors").arg(fabric))), weights);
            const json card = json::parse(bytesOf(at(QString("whole/%1.safetensors.json").arg(fabric))).toStdString());
            QCOMPARE(card["held_out"].dump(), std::string("[\"") + fabric + "\"]");
        }
        // Finished models are kept; those of other options are not taken for them.
        const QDateTime written = QFileInfo(at("whole/F02.safetensors")).lastModified();
        QFile::remove(at("whole/F01.safetensors"));
        const auto resumed = support::mustRun(call("whole") + QStringList{"--resume"});
        QCOMPARE(resumed.out, one.out);
        QCOMPARE(QFileInfo(at("whole/F02.safetensors")).lastModified(), written);
        QStringList longer = call("whole");
        longer[longer.indexOf("--steps") + 1] = "3";
        QCOMPARE(support::runProgram(longer + QStringList{"--resume"}).exitCode, 2);
        // Nor are those of the data set as it was before.
        QVERIFY(QFile::remove(at("fabrics/F01/visual/009.png")));
        isRefused(call("whole") + QStringList{"--resume"}, "the data set has changed");
        QFile::remove(at("whole/F01.safetensors"));
        for (int index = 2; index < 9; ++index) QFile::remove(at(QString("fabrics/F02/visual/00%1.png").arg(index)));
        QVERIFY(QFile::remove(at("fabrics/F02/visual/009.png")));
        isRefused(call("few"), "fabric F02 has too few photographs");
        QVERIFY(!QFile::exists(at("few")));
    }
};

QTEST_GUILESS_MAIN(MergeCommandTest)
#include "merge_command_test.moc"
