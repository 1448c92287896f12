// Evaluation on photographs with the surface that they show: each source of relief gets what it deserves, and the ridge
// regression never sees the fabric that it is tested on.
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/sha256.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/images/image_io.h"
#include "rendering/models/model_card_fields.h"
#include "study/evaluation/pixel_ridge.h"
#include "study/evaluation/surfaces.h"
#include "tests/rendering/refusal.h"
#include "tests/rendering/signals/oblique_waves.h"

namespace fabrics = rendering::fabrics;
namespace models = rendering::models;
using namespace study::evaluation;
using protocols::FabricId;

namespace {

constexpr int sidePx = 128, fabricCount = 4, places = 3;
constexpr float missing = std::numeric_limits<float>::quiet_NaN();

/// A photograph whose brightness is the slope to the right, as under a lamp on the right: the height itself is not in it.
cv::Mat lit(const scan_folders::KnownSurface& cloth, double sign)
{
    cv::Mat grey, rgb;
    cv::Mat(cloth.slopes.x * (-200 * sign) + 128).convertTo(grey, CV_8U);
    cv::cvtColor(grey, rgb, cv::COLOR_GRAY2RGB);
    return rgb;
}

scan_folders::KnownSurface clothAt(int fabric, int place)
{
    return scan_folders::unevenCloth({sidePx, sidePx}, 30, std::uint64_t(100 * fabric + place + 1));
}

/// Correlation with all waves.
double correlationOfAll(const cv::Mat& a, const cv::Mat& b)
{
    const cv::Mat first = a - cv::mean(a), second = b - cv::mean(b);
    return first.dot(second) / std::sqrt(first.dot(first) * second.dot(second));
}

}  // namespace

class EvaluationSurfacesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_temporary = std::make_unique<QTemporaryDir>();
        m_dataset = {};
        m_dataset.folder = m_temporary->path().toStdString();
        m_dataset.name = "scans";
        m_places.clear();
        m_surfaces.clear();
    }

    void eachSourceIsComparedPixelByPixel()
    {
        makeSet(fabricCount, {});
        const auto report = evaluateSurfaces(m_dataset, {}, {}, knowsAll());
        QCOMPARE(report.rows.size(), std::size_t(fabricCount));
        for (const SurfaceRow& row : report.rows) {
            QCOMPARE(row.light, std::string("one_lamp"));
            QCOMPARE(row.photographs, places);
            QVERIFY2(of(row, SeenRelief::Generated) > 0.98, qPrintable(QString::number(of(row, SeenRelief::Generated))));
            QVERIFY2(of(row, SeenRelief::Ridge) > 0.8, qPrintable(QString::number(of(row, SeenRelief::Ridge))));
            QVERIFY2(std::abs(of(row, SeenRelief::Photograph)) < 0.1,
                     qPrintable(QString::number(of(row, SeenRelief::Photograph))));
            QVERIFY(row.correlations.front().at4Mm.has_value());
        }
    }

    /// The light of one fabric comes from the other side: a regression that had seen it would not see its relief upside down.
    void ridgeNeverSeesTheFabricItIsTestedOn()
    {
        makeSet(fabricCount, {FabricId("F02")});
        const auto report = evaluateSurfaces(m_dataset, {}, {}, knowsAll());
        QVERIFY2(of(report.rows[1], SeenRelief::Ridge) < -0.8,
                 qPrintable(QString::number(of(report.rows[1], SeenRelief::Ridge))));
        QVERIFY(of(report.rows[0], SeenRelief::Ridge) > 0.3);
    }

    void oneFabricHasNoRidge()
    {
        makeSet(1, {});
        QCOMPARE(of(evaluateSurfaces(m_dataset, {}, {}, knowsAll()).rows.front(), SeenRelief::Ridge), 0.0);
    }

    void textAndJsonNameEverySource()
    {
        makeSet(2, {});
        EvaluationRequest request;
        request.samplesPerFabric = 1;
        const auto report = evaluateSurfaces(m_dataset, request, {}, knowsAll());
        QCOMPARE(report.rows.front().photographs, 1);
        const QString text = QString::fromStdString(surfacesText(report));
        const auto json = surfacesJson(report);
        QCOMPARE(json.at("schema").get<std::string>(), std::string("vis2hap.evaluation/1"));
        for (const SeenRelief source : allSeenReliefs) {
            QVERIFY(text.contains(QString::fromStdString(nameOf(source))));
            QVERIFY(json.at("surfaces").at(0).at(nameOf(source)).at("at_16_px").is_number());
        }
        QVERIFY(text.contains("one_lamp, 1 photographs of each fabric\n"));
        QCOMPARE(json.at("surfaces").at(0).at("lamp_told").get<bool>(), false);
    }

    /// Expected numbers: Student's t, computed in Python, also of the differences.
    void meansOverFabricsHaveIntervals()
    {
        std::vector<SurfaceRow> rows;
        const auto add = [&](double generated, double ridge, std::optional<double> at4Mm) {
            rows.push_back({FabricId("F0" + std::to_string(rows.size() + 1)), "cloth", "colour", 1, false, {}});
            rows.back().correlations = {{generated, at4Mm}, {}, {}, {ridge, at4Mm}};
        };
        add(0.5, 0.4, 0.3);
        add(0.7, 0.3, std::nullopt);
        add(0.6, 0.65, std::nullopt);
        std::vector<const SurfaceRow*> all{&rows[0], &rows[1], &rows[2]};
        const SourceSummary own = summaryOf(all, SeenRelief::Generated, false), ridge = summaryOf(all, SeenRelief::Ridge, false);
        const auto isNear = [](const stats::Interval& found, double low, double high) {
            return std::abs(*found.low - low) < 1e-4 && std::abs(*found.high - high) < 1e-4;
        };
        QCOMPARE(*own.mean, 0.6);
        QVERIFY(isNear(own.ci95, 0.3516, 0.8484));
        QVERIFY(isNear(ridge.generatedAboveCi95, -0.4192, 0.7192));
        QCOMPARE(ridge.fabricsBelow, 2);
        QCOMPARE(ridge.fabrics, 3);
        const SourceSummary at4Mm = summaryOf(all, SeenRelief::Generated, true);
        QCOMPARE(at4Mm.fabrics, 1);
        QVERIFY(*at4Mm.mean == 0.3 && !at4Mm.ci95.low.exists());
        SurfaceRow alone = rows[0];
        alone.hasRidge = false;
        QVERIFY(!summaryOf({&alone}, SeenRelief::Ridge, false).mean.exists());

        SurfaceReport report{"scans", "model", rows};
        const QString text = QString::fromStdString(surfacesText(report));
        QVERIFY2(text.contains("0.35 to 0.85") && text.contains("-0.42 to 0.72") && text.contains("2 of 3"), qPrintable(text));
        const auto json = surfacesJson(report).at("surface_means").at(0);
        QCOMPARE(json.at("light").get<std::string>(), std::string("colour"));
        QCOMPARE(json.at("ridge").at("at_16_px").at("generated_minus").at("fabrics_above").get<int>(), 2);
        QVERIFY(json.at("generated").at("at_4_mm").at("ci95").at(0).is_null());
        QVERIFY(!json.at("generated").at("at_4_mm").at("why").at("ci95").get<std::string>().empty());
    }

    /// Half of the photographs without a scale once halved the correlation at 4 mm.
    void aCorrelationAt4MmIsTheMeanOfThePhotographsWithAScale()
    {
        makeSet(2, {});
        const auto all = evaluateSurfaces(m_dataset, {}, {}, knowsAll());
        for (std::size_t i = 0; i < m_places.size(); i += 2) m_places[i].mmPerPixel.reset();
        fabrics::writeSamplePlaces(m_dataset, m_places);
        const auto some = evaluateSurfaces(m_dataset, {}, {}, knowsAll());
        for (std::size_t fabric = 0; fabric < 2; ++fabric) {
            const double was = *all.rows[fabric].correlations.front().at4Mm, is = *some.rows[fabric].correlations.front().at4Mm;
            QVERIFY2(std::abs(is - was) < 0.02, qPrintable(QString("%1 %2").arg(was).arg(is)));
        }
    }

    void onlyTheOneLampIsTold()
    {
        makeSet(2, {});
        for (auto& place : m_places) place.lightDeg = 135;
        for (std::size_t i = 0; i < m_places.size(); i += 2) m_places[i].light = "four_lamps";
        fabrics::writeSamplePlaces(m_dataset, m_places);
        std::vector<std::optional<double>> told;
        const Generate answer = knowsAll();
        const auto report = evaluateSurfaces(m_dataset, {}, {}, [&](auto photographs, const auto& options) {
            for (const auto& one : photographs) told.push_back(one.lightDeg);
            return answer(photographs, options);
        });
        QCOMPARE(std::ranges::count(told, std::optional(135.0)), std::ptrdiff_t(m_places.size() / 2));
        for (const SurfaceRow& row : report.rows) QCOMPARE(row.lampTold, row.light == "one_lamp");
        QVERIFY(surfacesText(report).find("the side of the lamp is told") != std::string::npos);
    }

    /// Before, a model's own training fabrics looked like any others.
    void drawnFabricsOfATrainingAreNamed()
    {
        makeSet(2, {});
        for (const auto& [name, isKnown] : {std::pair{"drawn fabrics, seed 31", true},
                                            {"drawn fabrics, seed 3", false},
                                            {"drawn fabrics, seed 31st", false},
                                            {"drawn fabrics, seed ", false},
                                            {"scans", false}}) {
            m_dataset.name = name;
            const auto surfaces = evaluateSurfaces(m_dataset, {}, {}, knowsAll());
            const QString text = QString::fromStdString(surfacesText(surfaces));
            QVERIFY2(text.contains("MEMORY: vis2hap was trained on fabrics that seed 31 draws") == isKnown, qPrintable(text));
            QCOMPARE(surfacesJson(surfaces).at("notes").size(), std::size_t(isKnown ? 1 : 0));
        }
    }

    void fabricsThatTheModelWasTrainedOnAreMarked()
    {
        makeSet(fabricCount, {});
        EvaluationRequest request;
        request.model = m_dataset.folder / "model.safetensors";
        const auto evaluatedWith = [&](const std::vector<std::string>& fabrics) {
            models::ModelCardFields card = models::readModelCardFields(models::shippedModel());
            for (const std::string& fabric : fabrics)
                card.summary.trainingSampleHashes.push_back(protocols::sha256OfFile(
                    fabrics::samplePath(m_dataset, FabricId(fabric), fabrics::Modality::Visual, places - 1)));
            std::ofstream(models::cardOf(request.model)) << models::cardText(card);
            return evaluateSurfaces(m_dataset, request, {}, knowsAll());
        };
        const auto none = evaluatedWith({});
        QVERIFY(surfacesText(none).find("MEMORY") == std::string::npos);
        QVERIFY(!surfacesJson(none).at("surface_means").at(0).contains("not_trained_on"));

        const auto two = evaluatedWith({"F02", "F04"});
        const QString text = QString::fromStdString(surfacesText(two));
        QVERIFY2(text.contains("trained on photographs of 2 of these 4 fabrics (F02, F04)"), qPrintable(text));
        QVERIFY2(text.contains("only the fabrics that the model was not trained on\n"), qPrintable(text));
        QCOMPARE(text.count("  F02 cloth F02"), 2);
        QCOMPARE(text.count("  F03 cloth F03"), 4);
        const auto means = surfacesJson(two).at("surface_means").at(0);
        QCOMPARE(means.at("fabrics_trained_on").get<int>(), 2);
        QCOMPARE(means.at("generated").at("at_16_px").at("fabrics").get<int>(), 4);
        QCOMPARE(means.at("not_trained_on").at("generated").at("at_16_px").at("fabrics").get<int>(), 2);
        QCOMPARE(surfacesJson(two).at("surfaces").at(1).at("photographs_trained_on").get<int>(), 1);

        // The regression of the only fabric left learned from the others.
        const auto three = surfacesJson(evaluatedWith({"F01", "F02", "F04"})).at("surface_means").at(0).at("not_trained_on");
        QVERIFY(three.at("ridge").at("at_16_px").at("mean").is_number());
        const auto all = surfacesJson(evaluatedWith({"F01", "F02", "F03", "F04"})).at("surface_means").at(0);
        QVERIFY(all.at("not_trained_on").is_null() && all.at("why").contains("not_trained_on"));
    }

    /// Before, one missing point made 0.00 of the fabric, and of the ridge of all others.
    void missingPointsAreLeftOutAndCounted()
    {
        makeSet(fabricCount, {});
        const auto before = evaluateSurfaces(m_dataset, {}, {}, knowsAll());
        QVERIFY(surfacesText(before).find("not measured") == std::string::npos);
        QVERIFY(!surfacesJson(before).at("surfaces").at(1).contains("left_out"));
        spoilSurface([](cv::Mat& surface) { surface.at<float>(40, 50) = missing; });
        const auto onePoint = evaluateSurfaces(m_dataset, {}, {}, knowsAll());
        spoilSurface([](cv::Mat& surface) { surface(cv::Rect(0, 0, sidePx, 60)).setTo(missing); });
        const auto half = evaluateSurfaces(m_dataset, {}, {}, knowsAll());
        for (std::size_t fabric = 0; fabric < std::size_t(fabricCount); ++fabric)
            for (const SeenRelief source : allSeenReliefs) {
                const double was = of(before.rows[fabric], source);
                QVERIFY2(std::abs(of(onePoint.rows[fabric], source) - was) < 0.005 &&
                             std::abs(of(half.rows[fabric], source) - was) < 0.02,
                         qPrintable(QString("%1 %2: %3, %4, %5")
                                        .arg(fabric)
                                        .arg(nameOf(source).c_str())
                                        .arg(was)
                                        .arg(of(onePoint.rows[fabric], source))
                                        .arg(of(half.rows[fabric], source))));
            }
        const int points = places * sidePx * sidePx;
        QVERIFY(surfacesText(onePoint).find("F02 cloth F02: 1 of " + std::to_string(points) +
                                            " points of its surfaces were not measured") != std::string::npos);
        QCOMPARE(surfacesJson(half).at("surfaces").at(1).at("left_out").at("points").get<int>(), sidePx * 60);
    }

    void aSurfaceThatCannotBeComparedIsRefusedByName_data()
    {
        QTest::addColumn<bool>("isMissing");
        QTest::addColumn<QString>("words");
        QTest::newRow("nothing measured in the middle") << true << "only 0 of the";
        QTest::newRow("another size") << false << "the surface has 64 × 64 px";
    }
    void aSurfaceThatCannotBeComparedIsRefusedByName()
    {
        QFETCH(bool, isMissing);
        QFETCH(QString, words);
        makeSet(2, {});
        spoilSurface([&](cv::Mat& surface) {
            if (isMissing)
                surface(cv::Rect(10, 10, sidePx - 20, sidePx - 20)).setTo(missing);
            else
                cv::resize(surface, surface, {sidePx / 2, sidePx / 2});
        });
        const QString refusal = refusalOf([&] { evaluateSurfaces(m_dataset, {}, {}, knowsAll()); });
        QVERIFY2(refusal.contains("F02/surface/001.tiff") && refusal.contains(words), qPrintable(refusal));
    }

    void aSurfaceWithGapsAgreesWithItself()
    {
        const cv::Mat surface = clothAt(1, 1).heightMm;
        cv::Mat gaps = surface.clone(), level = cv::Mat(surface.size(), CV_32FC1, cv::Scalar(3.7));
        cv::RNG random(3);
        for (int i = 0; i < sidePx * sidePx / 3; ++i)
            gaps.at<float>(random.uniform(0, sidePx), random.uniform(0, sidePx)) = missing;
        level.setTo(missing, (cv::abs(gaps) < 1e30) == 0);
        QVERIFY(std::abs(reliefCorrelation(surface, gaps) - 1) < 1e-9 && std::abs(reliefCorrelation(-surface, gaps) + 1) < 1e-9);
        QCOMPARE(reliefCorrelation(surface, level), 0.0);
        QCOMPARE(reliefCorrelation(cv::Mat(surface.size(), CV_32FC1, cv::Scalar(missing)), gaps), 0.0);
    }

    void longWavesAndShiftsAreNoAgreement()
    {
        const cv::Mat surface = clothAt(1, 1).heightMm;
        cv::Mat tilted = surface.clone();
        for (int x = 0; x < sidePx; ++x) tilted.col(x) += 0.002 * x;
        QVERIFY(correlationOfAll(tilted, surface) < 0.9 && reliefCorrelation(tilted, surface) > 0.99);
        QVERIFY(std::abs(reliefCorrelation(clothAt(1, 2).heightMm, surface)) < 0.3);
        QCOMPARE(reliefCorrelation(-surface, surface), -1.0);
        QCOMPARE(reliefCorrelation(cv::Mat::ones(surface.size(), CV_32FC1), surface), 0.0);
    }

private:
    static double of(const SurfaceRow& row, SeenRelief source) { return row.correlations.at(std::size_t(source)).at16Px; }

    /// A generator that knows the surfaces, at twice the pitch of the photographs.
    Generate knowsAll()
    {
        return [this](std::span<const models::InputPhotograph> photographs, const models::GenerationOptions&) {
            std::vector<models::GeneratedSignals> answers;
            for (const auto& one : photographs)
                for (const auto& [photograph, surface] : m_surfaces)
                    if (cv::norm(photograph, one.photograph, cv::NORM_INF) == 0) {
                        answers.emplace_back();
                        cv::resize(surface, answers.back().heightMm, {}, 2, 2, cv::INTER_CUBIC);
                    }
            return answers;
        };
    }

    /// Changes the stored surface of the second place of F02.
    void spoilSurface(const std::function<void(cv::Mat&)>& spoil) const
    {
        const auto file = fabrics::surfacePath(m_dataset, FabricId("F02"), 1);
        cv::Mat surface = fabrics::readSurface(m_dataset, FabricId("F02"), 1).value();
        spoil(surface);
        rendering::writeTiff(file, surface);
    }

    void makeSet(int count, const std::vector<FabricId>& litFromTheLeft)
    {
        for (int fabric = 0; fabric < count; ++fabric) {
            const FabricId id("F0" + std::to_string(fabric + 1));
            m_dataset.fabrics.push_back({id, "cloth " + id.value, ""});
            const bool isTurned = std::find(litFromTheLeft.begin(), litFromTheLeft.end(), id) != litFromTheLeft.end();
            for (int place = 0; place < places; ++place) {
                const auto cloth = clothAt(fabric, place);
                const cv::Mat photograph = lit(cloth, isTurned ? -1 : 1);
                const auto file = fabrics::samplePath(m_dataset, id, fabrics::Modality::Visual, place);
                const auto surface = fabrics::surfacePath(m_dataset, id, place);
                std::filesystem::create_directories(file.parent_path());
                std::filesystem::create_directories(surface.parent_path());
                rendering::writePng(file, photograph);
                rendering::writeTiff(surface, cloth.heightMm);
                m_surfaces.emplace_back(photograph, cloth.heightMm);
                fabrics::SamplePlace where{id, fabrics::Modality::Visual, place, {}, {}, {}, ""};
                where.light = "one_lamp";
                where.mmPerPixel = 30.0 / sidePx;
                m_places.push_back(where);
            }
        }
        fabrics::writeDatasetJson(m_dataset);
        fabrics::writeSamplePlaces(m_dataset, m_places);
    }

    std::unique_ptr<QTemporaryDir> m_temporary;
    fabrics::Dataset m_dataset;
    std::vector<fabrics::SamplePlace> m_places;
    std::vector<std::pair<cv::Mat, cv::Mat>> m_surfaces;
};

QTEST_GUILESS_MAIN(EvaluationSurfacesTest)
#include "evaluation_surfaces_test.moc"
