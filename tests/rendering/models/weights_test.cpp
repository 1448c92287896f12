// Unusable weights files and model cards are refused in one line; the weights of the program load.
#include <sys/stat.h>

#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "rendering/models/generation.h"
#include "rendering/models/model_card_fields.h"
#include "tests/rendering/spoilt_tensors.h"

using namespace rendering;
namespace fs = std::filesystem;

namespace {

std::string bytesOf(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

}  // namespace

class WeightsTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;

    fs::path model() const { return fs::path(m_folder.path().toStdString()) / "model.safetensors"; }

    QString faultOfGenerating() const
    {
        const models::InputPhotograph photograph{cv::Mat(64, 64, CV_8UC3, cv::Scalar::all(100)), std::nullopt};
        models::GenerationOptions options;
        options.model = model();
        options.quality = models::Quality::Fast;
        try {
            models::generate(std::span(&photograph, 1), options);
        } catch (const protocols::Error& fault) {
            return QString::number(static_cast<int>(fault.exitCode())) + " " + fault.what();
        }
        return "0";
    }

    /// Writes the card of the program's weights for other bytes.
    void writeCardFor(const std::string& weights)
    {
        models::ModelCardFields card = models::readModelCardFields(models::shippedModel());
        card.summary.sha256 = protocols::sha256(weights);
        write(models::cardOf(model()), models::cardText(card));
    }

private Q_SLOTS:
    void init()
    {
        fs::remove_all(model());
        fs::remove_all(models::cardOf(model()));
        fs::copy_file(models::shippedModel(), model(), fs::copy_options::overwrite_existing);
        fs::copy_file(models::cardOf(models::shippedModel()), models::cardOf(model()), fs::copy_options::overwrite_existing);
    }

    void shippedWeightsLoad()
    {
        QCOMPARE(faultOfGenerating(), "0");
        QVERIFY(fs::file_size(models::shippedModel()) + fs::file_size(models::cardOf(models::shippedModel())) < (4U << 20U));
    }

    void aCardKeepsWhatItKnowsOfFibres()
    {
        models::ModelCardFields card = models::readModelCardFields(models::shippedModel());
        card.architecture.fibres = {};
        card.architecture.fibres[std::size_t(fabrics::Fibre::Jute)] = models::FibreReading{-0.01, 1.25, 0.5};
        write(models::cardOf(model()), models::cardText(card));
        QVERIFY(models::readModelCardFields(model()).architecture == card.architecture);
        QString text = QString::fromStdString(models::cardText(card));
        write(models::cardOf(model()), text.replace("1.25", "-1.25").toStdString());
        QVERIFY(faultOfGenerating().contains("sizes out of range"));
    }

    void shippedCardStatesItsOrigin()
    {
        const models::ModelCardFields card = models::readModelCardFields(models::shippedModel());
        QVERIFY(card.architecture.sees);
        QVERIFY(card.summary.trainingCommand.find("train --drawn") != std::string::npos);
        // Its training saw 612 pictures of eight scans, some of them twice. The card names the files, and remembers none.
        const std::vector<std::string>& hashes = card.summary.trainingSampleHashes;
        QCOMPARE(hashes.size(), std::size_t{561});
        QVERIFY(std::ranges::is_sorted(hashes) && std::ranges::adjacent_find(hashes) == hashes.end());
        QVERIFY(std::ranges::all_of(hashes, [](const std::string& hash) { return hash.size() == 64; }));
        const auto validation = nlohmann::ordered_json::parse(card.validationJson);
        QVERIFY(validation.at("friction_error").get<double>() < validation.at("friction_constant_error").get<double>());
        QVERIFY(validation.at("relief_correlation").get<double>() > 0.4);
    }

    /// A data set of drawn fabrics that has one of these seeds tests memory.
    void aCardNamesTheSeedsOfItsDrawnFabrics()
    {
        using Seeds = std::set<std::uint64_t>;
        QVERIFY((models::readModelCard(models::shippedModel()).drawnSeeds == Seeds{1, 31}));
        QVERIFY(models::readModelCard(models::earlierModel()).drawnSeeds.empty());

        const std::string sound = bytesOf(models::cardOf(models::shippedModel()));
        const std::string listed = "[\n  1,\n  31\n ]";
        const std::size_t place = sound.find(listed), key = sound.find(" \"drawn_seeds\"");
        QVERIFY(place != std::string::npos && key < place);
        std::string older = sound;
        older.erase(key, place + listed.size() + 2 - key);
        write(models::cardOf(model()), older);
        QVERIFY((models::readModelCard(model()).drawnSeeds == Seeds{31}));
        for (const char* wrong : {"[-1]", "[1.5]", "[\"1\"]", "7"}) {
            write(models::cardOf(model()), std::string(sound).replace(place, listed.size(), wrong));
            const QString fault = faultOfGenerating();
            QVERIFY2(fault.startsWith("2 ") && fault.contains("the model card cannot be used"), qPrintable(fault));
        }
    }

    /// Version 0.5.0 stored known photographs and fabrics in its card. Such cards are read; what they remember is not.
    void olderWeightsAreReadWithoutTheirMemory()
    {
        const fs::path old = models::earlierModel();
        fs::copy_file(old, model(), fs::copy_options::overwrite_existing);
        std::string card = bytesOf(models::cardOf(old));
        card.insert(card.rfind("\n}"), ",\n \"photographs\": {\"nearest\": [[1, 2]]}, \"friction_by_texture\": 7");
        write(models::cardOf(model()), card);
        QCOMPARE(faultOfGenerating(), "0");
    }

    void cardIsReadBackAsWritten()
    {
        const models::ModelCardFields card = models::readModelCardFields(models::shippedModel());
        QCOMPARE(QString::fromStdString(models::cardText(card)),
                 QString::fromStdString(bytesOf(models::cardOf(models::shippedModel()))));
    }

    /// Before, 24 + 2^32 and 24.9 channels were taken as 24.
    void countsOfACardAreWhole()
    {
        const QString sound = QString::fromStdString(bytesOf(models::cardOf(models::shippedModel())));
        for (const char* altered :
             {"\"base_channels\": 4294967320", "\"base_channels\": 24.9", "\"steps\": -1e300", "\"seed\": -1"}) {
            const QString name = QString(altered).section(':', 0, 0);
            const QString from = name + (name.contains("base") ? ": 24" : name.contains("steps") ? ": 3600" : ": 31");
            QVERIFY(sound.contains(from));
            write(models::cardOf(model()), QString(sound).replace(from, altered).toStdString());
            const QString fault = faultOfGenerating();
            QVERIFY2(fault.startsWith("2 ") && fault.contains("is no whole number from 0"), qPrintable(fault));
        }
    }

    void unusableWeightsAreRefused_data()
    {
        QTest::addColumn<QString>("harm");
        for (const char* harm : {"truncated",
                                 "truncated, card fits",
                                 "empty, card fits",
                                 "no tensors, card fits",
                                 "archive, card fits",
                                 "not finite",
                                 "altered byte",
                                 "missing",
                                 "card missing",
                                 "card of another schema",
                                 "card no JSON",
                                 "pipe",
                                 "card a pipe",
                                 "huge",
                                 "card huge",
                                 "folder",
                                 "card of other networks",
                                 "card with absurd sizes",
                                 "card with a vast spectrogram",
                                 "card with a hollow spectrogram",
                                 "card nested deeply"})
            QTest::newRow(harm) << harm;
    }

    void unusableWeightsAreRefused()
    {
        QFETCH(QString, harm);
        const std::string whole = bytesOf(model()), card = bytesOf(models::cardOf(model()));
        std::string bytes = whole;
        if (harm.startsWith("truncated"))
            bytes.resize(bytes.size() / 2);
        else if (harm.startsWith("empty"))
            bytes.clear();
        else if (harm.startsWith("no tensors"))
            bytes = "these are no weights";
        else if (harm.startsWith("archive"))
            bytes = std::string("PK\x03\x04", 4) + bytes;
        else if (harm == "not finite")
            bytes = support::withNumbersSpoilt(bytes, "F16", std::string("\x00\x7E", 2));
        else if (harm == "altered byte")
            bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
        write(model(), bytes);
        if (harm.endsWith("card fits") || harm == "not finite")
            writeCardFor(bytes);
        else if (harm == "pipe" || harm == "folder" || harm == "card a pipe")
            putInstead(harm.startsWith("card") ? models::cardOf(model()) : model(), harm == "folder");
        else if (harm.endsWith("huge"))
            fs::resize_file(harm.startsWith("card") ? models::cardOf(model()) : model(), std::uintmax_t{1} << 42);
        else if (harm == "missing")
            fs::remove(model());
        else if (harm == "card missing")
            fs::remove(models::cardOf(model()));
        else if (harm == "card no JSON")
            write(models::cardOf(model()), card.substr(0, card.size() / 3));
        else if (harm.startsWith("card"))
            alterCard(harm, card);
        const QString fault = faultOfGenerating();
        QVERIFY2(fault.startsWith("2 ") && fault.contains("model.safetensors") && !fault.contains('\n'), qPrintable(fault));
        if (harm == "not finite") QVERIFY2(fault.contains("not finite"), qPrintable(fault));
        if (harm.startsWith("archive")) QVERIFY2(fault.contains("archive of objects, which can hold code"), qPrintable(fault));
    }

private:
    static void putInstead(const fs::path& file, bool folder)
    {
        fs::remove(file);
        if (folder)
            fs::create_directory(file);
        else
            QVERIFY(::mkfifo(file.c_str(), 0600) == 0);
    }

    void alterCard(const QString& harm, std::string card)
    {
        const auto replace = [&](const std::string& what, const std::string& with) {
            const std::size_t at = card.find(what);
            QVERIFY(at != std::string::npos);
            card.replace(at, what.size(), with);
        };
        if (harm == "card of another schema")
            replace("vis2hap.model/2", "vis2hap.model/9");
        else if (harm == "card with a vast spectrogram")
            replace("\"frames\": 31", "\"frames\": 65535, \"unused\": 31");
        else if (harm == "card with a hollow spectrogram")
            replace("\"hop\": 16", "\"hop\": 0");
        else if (harm == "card nested deeply")
            replace("\"validation\": {",
                    "\"validation\": {\"deep\": " + std::string(200'000, '[') + std::string(200'000, ']') + ", ");
        else if (harm == "card of other networks")
            replace("\"base_channels\": 24", "\"base_channels\": 16");
        else
            replace("\"base_channels\": 24", "\"base_channels\": 99999");
        write(models::cardOf(model()), card);
    }
};

QTEST_GUILESS_MAIN(WeightsTest)
#include "weights_test.moc"
