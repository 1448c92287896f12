// Files of shards: written whole, read strictly, and joined only where they are the shards of one run.
#include "study/shards/shard_file.h"

#include <QTemporaryDir>
#include <QTest>
#include <numeric>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

using namespace study::shards;
namespace fs = std::filesystem;

namespace {

/// The message of the refusal; empty where nothing was refused.
template <class Act>
std::string refusalOf(const Act& act)
{
    try {
        act();
    } catch (const protocols::Error& error) {
        return error.exitCode() == protocols::ExitCode::BadInput ? error.what() : "another exit code";
    }
    return {};
}

bool names(const std::string& message, const char* what) { return message.find(what) != std::string::npos; }

}  // namespace

class ShardFileTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;

    fs::path at(const std::string& name) const { return fs::path(m_folder.path().toStdString()) / name; }

    Shard shard(std::size_t part, std::size_t parts) const
    {
        return {"vis2hap 1.2.3", "power", {{"studies", 40}, {"seed", 7}}, {part, parts}, {{"sum", part * 0.1}}};
    }

    /// Writes all shards of a run.
    std::vector<fs::path> runOf(std::size_t parts) const
    {
        std::vector<fs::path> files;
        for (std::size_t part = 0; part < parts; ++part) {
            files.push_back(at("shard" + std::to_string(part + 1)));
            writeShard(files.back(), shard(part, parts));
        }
        return files;
    }

private Q_SLOTS:
    void everyItemIsInOneShare()
    {
        for (const std::size_t items : {0, 1, 7, 40})
            for (const std::size_t parts : {1, 2, 3, 7, 50}) {
                std::vector<int> counts(items);
                for (std::size_t part = 0; part < parts; ++part) {
                    const stats::Share share{part, parts};
                    for (std::size_t i = 0; i < share.sizeOf(items); ++i) ++counts.at(share.item(i));
                }
                QCOMPARE(std::accumulate(counts.begin(), counts.end(), 0), static_cast<int>(items));
                QVERIFY(std::ranges::all_of(counts, [](int count) { return count == 1; }));
            }
    }

    void aShardIsNamedByItsNumberFromOne()
    {
        QVERIFY((shareNamed("3/16") == stats::Share{2, 16}));
        QVERIFY((shareNamed("1/1") == stats::Share{0, 1}));
        QCOMPARE(textOf({2, 16}), std::string("3/16"));
        for (const char* wrong : {"", "3", "0/4", "5/4", "-1/4", "1/0", "1/2/3", "1.5/2", " 1/2", "1/100001", "a/b"})
            QVERIFY2(names(refusalOf([&] { shareNamed(wrong); }), "is no shard"), wrong);
    }

    void shardsAreReadInTheOrderOfTheirNumbers()
    {
        auto files = runOf(12);
        std::ranges::reverse(files);
        const ShardedRun run = readRun(files, "vis2hap 1.2.3");
        QCOMPARE(run.shards.size(), std::size_t(12));
        for (std::size_t part = 0; part < 12; ++part) {
            QCOMPARE(run.shards[part].values.at("sum").get<double>(), static_cast<double>(part) * 0.1);
            QCOMPARE(run.files[part].filename().string(), "shard" + std::to_string(part + 1));
        }
        QCOMPARE(run.command(), std::string("power"));
        QCOMPARE(run.options().at("seed").get<int>(), 7);
    }

    void missingAndDoubledShardsAreNamed()
    {
        auto files = runOf(5);
        files.erase(files.begin() + 3);
        files.erase(files.begin() + 1);
        QVERIFY(names(refusalOf([&] { readRun(files, "vis2hap 1.2.3"); }), "shard 2 and 4 of 5 is missing"));
        files = runOf(5);
        files.pop_back();
        const std::string missing = refusalOf([&] { readRun(files, "vis2hap 1.2.3"); });
        QVERIFY(names(missing, "shard 5 of 5 is missing") && names(missing, "--shard 5/5"));
        files = runOf(3);
        fs::copy_file(files[1], at("copy"));
        files.push_back(at("copy"));
        const std::string doubled = refusalOf([&] { readRun(files, "vis2hap 1.2.3"); });
        QVERIFY2(names(doubled, "shard 2/3 occurs twice") && names(doubled, "copy"), doubled.c_str());
    }

    void shardsOfOtherRunsAreRefused()
    {
        const auto refusedWith = [&](Shard other, const char* what) {
            auto files = runOf(3);
            writeShard(files[1], other);
            const std::string message = refusalOf([&] { readRun(files, "vis2hap 1.2.3"); });
            QVERIFY2(names(message, what), message.c_str());
        };
        Shard other = shard(1, 3);
        other.options["seed"] = 8;
        refusedWith(other, "another \"seed\"");
        other = shard(1, 3);
        other.options["more"] = true;
        refusedWith(other, "another \"more\"");
        other = shard(1, 3);
        other.command = "simulate";
        refusedWith(other, "vis2hap simulate");
        refusedWith(shard(1, 4), "one of 4, not of 3");
        other = shard(1, 3);
        other.program = "vis2hap 1.2.4";
        refusedWith(other, "made by vis2hap 1.2.4");
        QVERIFY(names(refusalOf([&] { readRun(runOf(2), "vis2hap 9"); }), "made by vis2hap 1.2.3"));
    }

    void damagedAndAlteredShardsAreRefused()
    {
        writeShard(at("sound"), shard(0, 2));
        const std::string sound = protocols::readWholeFile(at("sound"));
        QVERIFY(shardFrom(sound, "sound").share == (stats::Share{0, 2}));
        // Cut anywhere, or with another byte anywhere, it is no shard of this run any more.
        for (std::size_t length = 0; length + 2 < sound.size(); length += 7)
            QVERIFY(!refusalOf([&] { shardFrom(sound.substr(0, length), "cut"); }).empty());
        for (std::size_t place = 0; place < sound.size(); ++place) {
            std::string changed = sound;
            if (changed[place] == ' ' || changed[place] == '\n') continue;
            changed[place] = changed[place] == '1' ? '2' : '1';
            QVERIFY2(!refusalOf([&] { shardFrom(changed, "changed"); }).empty(), changed.c_str());
        }
        for (const char* text : {"[]", "{}", "null", "{\"schema\":\"vis2hap.power/1\"}", "{\"schema\":\"vis2hap.shard/1\"}"})
            QVERIFY(!refusalOf([&] { shardFrom(text, "text"); }).empty());
    }

    void anotherProgramMayWriteTheKeysInAnotherOrder()
    {
        writeShard(at("sound"), shard(1, 2));
        const std::string text = protocols::readWholeFile(at("sound"));
        const std::string sorted = nlohmann::json::parse(text).dump();
        QVERIFY(sorted != nlohmann::ordered_json::parse(text).dump());
        QCOMPARE(shardFrom(sorted, "sorted").values.at("sum").get<double>(), 0.1);
    }
};

QTEST_GUILESS_MAIN(ShardFileTest)
#include "shard_file_test.moc"
