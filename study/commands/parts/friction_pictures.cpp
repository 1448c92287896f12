#include "study/commands/parts/friction_pictures.h"

#include <QBuffer>
#include <QImage>

#include "database/keys.h"
#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "study/session/stimuli.h"

namespace study::commands {

namespace {

constexpr std::size_t mostFabrics = 20, mostConditions = 12;

/// The middle of an image as a PNG file in Base64.
std::string middleOf(const cv::Mat& image)
{
    const int width = std::min(reports::pictureWidth, image.cols), height = std::min(reports::pictureHeight, image.rows);
    const cv::Mat part = image(cv::Rect((image.cols - width) / 2, (image.rows - height) / 2, width, height));
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    QImage(part.data, width, height, qsizetype(part.step[0]), QImage::Format_Grayscale8).save(&buffer, "PNG");
    return bytes.toBase64().toStdString();
}

}  // namespace

std::vector<reports::FrictionPicture> frictionPictures(const database::StudyStore& store, const reports::StudyData& data,
                                                       const std::function<void(const std::string& line)>& note)
{
    const auto permission = database::recordedUnblinding(store);
    if (!permission || data.fabrics.size() > mostFabrics || data.conditions.size() > mostConditions) return {};
    std::vector<reports::FrictionPicture> pictures;
    try {
        const auto key = database::readAllocationKey(store, *permission);
        auto bank = session::stimuliOf(store);
        for (const auto& [code, entry] : key.entries)
            if (entry.condition != protocols::catchTrialId())
                pictures.push_back({entry.condition.value, entry.fabric.value, middleOf(bank.imageOf(code))});
    } catch (const protocols::Error& error) {
        note(std::string("no figure of the friction images: ") + error.what());
        return {};
    }
    return pictures;
}

}  // namespace study::commands
