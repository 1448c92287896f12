// Contact sheet of a data set: one row for each fabric with the signals that exist, and a refusal if there are none.
#include <QImage>
#include <QRect>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/images/image_io.h"
#include "study/looking/render_sheet.h"

using namespace rendering;
using study::looking::contactSheetOf;
namespace fs = std::filesystem;

namespace {

/// Replaces the generators.
std::vector<models::GeneratedSignals> generated(std::span<const models::InputPhotograph> photographs,
                                                const models::GenerationOptions&)
{
    std::vector<models::GeneratedSignals> answers(photographs.size());
    for (std::size_t i = 0; i < answers.size(); ++i) {
        cv::extractChannel(photographs[i].photograph, answers[i].heightMm, 1);
        answers[i].heightMm.convertTo(answers[i].heightMm, CV_32F, 0.001);
        answers[i].heightMmPerPixel = 0.05;
        answers[i].spectrogram = cv::Mat::ones(33, 7, CV_32FC1);
        answers[i].meanFriction = 0.3;
        for (int k = 0; k < 200; ++k) answers[i].trace.push_back(0.3 + 0.05 * std::sin(k * 0.4));
        answers[i].traceMmPerSample = 5.0 / 60;
    }
    return answers;
}

RenderRequest requestFor(const fabrics::Dataset& dataset)
{
    RenderRequest request;
    for (const auto& fabric : dataset.fabrics) request.fabrics.push_back(fabric.id);
    request.generate = generated;
    return request;
}

/// Whether the cell has a picture. A note leaves most of its cell white.
bool hasPicture(const QImage& image, const QRect& part)
{
    int white = 0;
    for (int y = part.top(); y < part.bottom(); ++y)
        for (int x = part.left(); x < part.right(); ++x) white += image.pixel(x, y) == qRgb(255, 255, 255) ? 1 : 0;
    return white < part.width() * part.height() / 2;
}

/// Cell of a map in a row of the sheet. `number`: 0 photograph, 1 measured height, 2 generated height.
QRect mapCell(int row, int number) { return {152 + number * 204, 92 + row * 252, 190, 190}; }

}  // namespace

class ContactSheetTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    fabrics::Dataset m_dataset;

    /// A copy of the data set without some signals.
    fabrics::Dataset without(const char* name, std::initializer_list<const char*> modalities) const
    {
        const fs::path copy = m_folder.filePath(name).toStdString();
        fs::copy(m_dataset.folder, copy, fs::copy_options::recursive);
        for (const auto& fabric : m_dataset.fabrics)
            for (const char* modality : modalities) fs::remove_all(copy / fabric.id.value / modality);
        return fabrics::readDataset(copy);
    }

private Q_SLOTS:
    void initTestCase()
    {
        fabrics::ProceduralOptions options;
        options.fabrics = 2;
        options.samples = 1;
        m_dataset = fabrics::makeProceduralFabrics(m_folder.filePath("fabrics").toStdString(), options);
    }

    void everyFabricHasARowWithAllItsSignals()
    {
        const auto sheet = contactSheetOf(m_dataset, requestFor(m_dataset));
        QCOMPARE(sheet.rows.size(), std::size_t{2});
        const auto& row = sheet.rows[1];
        QCOMPARE(row.name, m_dataset.fabrics[1].name);
        QVERIFY(!row.measuredHeight.values.empty() && !row.measuredFriction.values.empty() &&
                !row.generatedFriction.values.empty());
        QCOMPARE(row.frictionImages.size(), std::size_t{3});
        QVERIFY(sheet.rows[0].remark.empty());

        const fs::path png = m_folder.filePath("sheet.png").toStdString();
        study::looking::writeContactSheet(png, sheet);
        const QImage image(m_folder.filePath("sheet.png"));
        QCOMPARE(image.height(), 92 + 2 * 252 + 18);
        QVERIFY(image.width() > 1800);
        for (int fabric = 0; fabric < 2; ++fabric)
            for (int map = 0; map < 3; ++map) QVERIFY2(hasPicture(image, mapCell(fabric, map)), qPrintable(QString::number(map)));
        QVERIFY(image.copy(mapCell(0, 2)) != image.copy(mapCell(1, 2)));
    }

    void photographsGiveTheGeneratedSignals()
    {
        const auto dataset = without("photographs", {"tactile", "friction", "height"});
        const auto sheet = contactSheetOf(dataset, requestFor(dataset));
        QVERIFY(sheet.rows[0].measuredHeight.values.empty() && sheet.rows[0].measuredFriction.values.empty());
        QVERIFY(!sheet.rows[0].generatedHeight.values.empty() && !sheet.rows[0].frictionImages[2].empty());
        const QImage image = study::looking::drawContactSheet(sheet, study::looking::lightSheet());
        QVERIFY(hasPicture(image, mapCell(0, 0)));
        QVERIFY(!hasPicture(image, mapCell(0, 1)));  // "not measured"
        QVERIFY(hasPicture(image, mapCell(0, 2)));
    }

    void aPhotographOfSomethingElseIsRemarked()
    {
        const auto dataset = without("strange", {"tactile"});
        const cv::Mat black(300, 300, CV_8UC3, cv::Scalar::all(0));
        writePng(dataset.folder / "F02" / "visual" / "000.png", black);
        const auto sheet = contactSheetOf(dataset, requestFor(dataset));
        QVERIFY(sheet.rows[0].remark.empty());
        QCOMPARE(sheet.rows[1].remark, std::string("not like cloth: means nothing"));
    }

    void recordingsWithoutPhotographsNeedNoGenerators()
    {
        const auto dataset = without("recordings", {"visual"});
        RenderRequest request = requestFor(dataset);
        request.generate = [](auto, const auto&) -> std::vector<models::GeneratedSignals> { throw std::logic_error("asked"); };
        const auto sheet = contactSheetOf(dataset, request);
        QVERIFY(!sheet.rows[0].measuredHeight.values.empty());
        QVERIFY(sheet.rows[0].frictionImages[0].empty());
        const QImage image = study::looking::drawContactSheet(sheet, study::looking::lightSheet());
        QVERIFY(!hasPicture(image, mapCell(0, 0)));
    }

    void mapsOfKnownScaleShowEqualLengths()
    {
        study::looking::ContactSheet sheet{"scales", {}, std::vector<study::looking::ContactRow>(1)};
        cv::Mat coarse(100, 100, CV_32FC1, cv::Scalar(0)), fine(200, 200, CV_32FC1, cv::Scalar(0));
        coarse.colRange(50, 100).setTo(1);  // 0.1 mm per pixel: 10 mm wide
        fine.colRange(100, 200).setTo(1);   // 0.025 mm per pixel: 5 mm wide
        coarse.col(26).setTo(0.5);          // 2.4 mm left of the middle: just inside the common 5 mm
        sheet.rows[0].measuredHeight = {coarse, 0.1};
        sheet.rows[0].generatedHeight = {fine, 0.025};
        const QImage image = study::looking::drawContactSheet(sheet, study::looking::lightSheet());
        const QRect cell = mapCell(0, 1);
        QVERIFY(image.pixel(cell.left() + 6, cell.center().y()) != image.pixel(cell.left() + 30, cell.center().y()));
        QCOMPARE(image.pixel(cell.left() + 30, cell.center().y()), image.pixel(mapCell(0, 2).left() + 30, cell.center().y()));
    }

    void nothingToDrawIsRefused()
    {
        const auto dataset = without("nothing", {"visual", "tactile", "friction", "height"});
        try {
            contactSheetOf(dataset, requestFor(dataset));
            QFAIL("an empty sheet was drawn");
        } catch (const protocols::Error& fault) {
            QCOMPARE(fault.exitCode(), protocols::ExitCode::BadInput);
            QVERIFY2(QString(fault.what()).contains("have no photograph, no measured height"), fault.what());
        }
    }
};

QTEST_MAIN(ContactSheetTest)
#include "contact_sheet_test.moc"
