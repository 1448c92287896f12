// Results kept on disk: found again, never believed when damaged, for their owner alone, and bounded in size.
#include "rendering/cache/result_cache.h"

#include <sys/stat.h>

#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>

#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "rendering/cache/cache_key.h"
#include "rendering/cache/packed_result.h"
#include "tests/rendering/refusal.h"

using namespace rendering::cache;

namespace {

namespace fs = std::filesystem;

std::string keyFor(const std::string& name) { return protocols::sha256(name); }

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

unsigned modeOf(const fs::path& path)
{
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 0777U : 0;
}

/// Sets the times of a file back, as if it had been written long ago.
void age(const fs::path& file) { fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(48)); }

std::size_t filesIn(const fs::path& folder)
{
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

class ResultCacheTest : public QObject {
    Q_OBJECT
private:
    fs::path place(const char* name) const { return fs::path(m_temporary.path().toStdString()) / name; }
    QTemporaryDir m_temporary;

private Q_SLOTS:
    void whatWasKeptIsFoundByTheNextProcess()
    {
        const std::string bytes("height\0map\n", 11);
        {
            ResultCache cache(place("kept"));
            QVERIFY(!cache.find(keyFor("a")));
            cache.keep(keyFor("a"), bytes);
        }
        ResultCache cache(place("kept"));
        QCOMPARE(cache.find(keyFor("a")).value_or(""), bytes);
        QVERIFY(!cache.find(keyFor("b")));
        QCOMPARE(cache.use().found, 1);
        QCOMPARE(cache.use().missing, 1);
    }

    void folderAndEntriesAreForTheirOwnerAlone()
    {
        const auto before = ::umask(0);
        ResultCache cache(place("private"));
        cache.keep(keyFor("a"), "signal");
        ::umask(before);
        QCOMPARE(modeOf(place("private")), 0700U);
        QCOMPARE(modeOf(place("private") / keyFor("a")), 0600U);
    }

    void damagedOrMovedEntriesAreNotBelieved()
    {
        ResultCache cache(place("damaged"));
        cache.keep(keyFor("a"), "a signal of a fabric");
        const auto file = place("damaged") / keyFor("a");
        const auto whole = protocols::readWholeFile(file);
        fs::copy_file(file, place("damaged") / keyFor("b"));
        QVERIFY(!cache.find(keyFor("b")));  // of another key
        auto changed = whole;
        changed.back() ^= 1;
        for (const auto& damaged :
             {changed, whole.substr(0, whole.size() - 1), whole + "x", whole.substr(0, 10), std::string()}) {
            write(file, damaged);
            QVERIFY(!cache.find(keyFor("a")));
        }
        write(file, whole);
        QVERIFY(cache.find(keyFor("a")));
        QCOMPARE(cache.use().damaged, 6);
    }

    void folderThatOthersMayWriteToIsNotUsed()
    {
        fs::create_directory(place("open"));
        fs::permissions(place("open"), fs::perms::all);
        ResultCache cache(place("open"));
        QVERIFY(!cache.isUsable());
        cache.keep(keyFor("a"), "signal");
        QVERIFY(!cache.find(keyFor("a")));
        QCOMPARE(filesIn(place("open")), std::size_t{0});
        // A file where the folder should be costs only the reuse.
        write(place("file"), "");
        QVERIFY(!ResultCache(place("file")).isUsable());
    }

    void whatWasNotUsedForLongestIsRemovedFirst()
    {
        const std::string bytes(20'000, 's');
        {
            ResultCache cache(place("small"), 100'000);
            for (const char* name : {"a", "b", "c", "d"}) cache.keep(keyFor(name), bytes);
            for (const char* name : {"a", "b", "c", "d"}) age(place("small") / keyFor(name));
            QVERIFY(cache.find(keyFor("a")));  // used now
            cache.keep(keyFor("e"), bytes);
            cache.keep(keyFor("too large"), std::string(50'000, 's'));
        }
        ResultCache cache(place("small"), 100'000);
        QVERIFY(cache.find(keyFor("a")));
        QVERIFY(cache.find(keyFor("e")));
        QVERIFY(!cache.find(keyFor("too large")));
        QVERIFY(filesIn(place("small")) < 5);
    }

    void hashOfAFileIsReadAgainOnlyAfterAChange()
    {
        const auto file = place("photograph");
        write(file, "first content");
        ResultCache cache(place("hashes"));
        QCOMPARE(cache.hashOfFile(file), protocols::sha256("first content"));
        write(file, "other content");  // the same size, at once
        QCOMPARE(cache.hashOfFile(file), protocols::sha256("other content"));
        fs::remove(file);
        QVERIFY(refusalOf([&] { cache.hashOfFile(file); }).contains("cannot be read"));
    }

    void rememberedHashSurvivesItsProcessAndNotAChangeOfTheFile()
    {
        const auto file = place("old");
        write(file, "first content");
        QTest::qSleep(2100);  // so that the times of the file can show a later change
        {
            ResultCache cache(place("remembered"));
            (void)cache.hashOfFile(file);
        }
        QCOMPARE(filesIn(place("remembered")), std::size_t{1});
        ResultCache cache(place("remembered"));
        QCOMPARE(cache.hashOfFile(file), protocols::sha256("first content"));
        write(file, "other content");
        fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));  // set back by hand
        QCOMPARE(cache.hashOfFile(file), protocols::sha256("other content"));
    }

    void keysDifferWithEveryInput()
    {
        ResultCache cache(place("keys"));
        const auto key = [&](auto... values) {
            CacheKey made(cache, "height");
            (made.add("value", values), ...);
            return made.hex();
        };
        QCOMPARE(key("ab", "c"), key("ab", "c"));
        QVERIFY(key("ab", "c") != key("a", "bc"));
        QVERIFY(key(0.1) != key(std::nextafter(0.1, 1)));
        QVERIFY(key(std::optional<double>()) != key(std::optional(0.0)));
        QVERIFY(CacheKey(cache, "height").hex() != CacheKey(cache, "relief").hex());
    }

    void arraysComeBackBitByBit()
    {
        cv::Mat map(3, 5, CV_32FC1), trace(2, 1, CV_64FC1, cv::Scalar(1.0 / 3)), photograph(2, 2, CV_8UC3, cv::Scalar(1, 2, 3));
        cv::randu(map, 0, 1);
        const auto bytes = packed({R"({"mean":0.1})", {map.colRange(1, 4), trace, photograph, cv::Mat()}});
        const auto result = unpacked(bytes);
        QVERIFY(result.has_value());
        QCOMPARE(result->factsJson, std::string(R"({"mean":0.1})"));
        QCOMPARE(result->arrays.size(), std::size_t{4});
        QCOMPARE(cv::norm(result->arrays[0], map.colRange(1, 4), cv::NORM_INF), 0.0);
        QCOMPARE(cv::norm(result->arrays[1], trace, cv::NORM_INF), 0.0);
        QCOMPARE(cv::norm(result->arrays[2], photograph, cv::NORM_INF), 0.0);
        QVERIFY(result->arrays[3].empty());
        for (const std::string& wrong : {bytes.substr(0, bytes.size() - 1), std::string("no head"), std::string("{}\n"),
                                         std::string(R"({"facts":{},"arrays":[[-1,2,5]]})"
                                                     "\n"),
                                         std::string("{\"facts\":{},\"arrays\":[[1e300,2,5]]}\n")})
            QVERIFY(!unpacked(wrong));
    }
};

QTEST_APPLESS_MAIN(ResultCacheTest)
#include "result_cache_test.moc"
