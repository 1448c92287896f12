#include "tests/fuzz/settings_readers.h"

#include <QSettings>
#include <fstream>
#include <stdexcept>

#include "rendering/display/test_patterns.h"
#include "study/app/kept_settings.h"
#include "study/app/state/key_bindings.h"
#include "study/app/state/recent_studies.h"
#include "study/app/state/tried_display.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;
using namespace study::app;

/// An extra key acts for one act alone, and is the standard key of none.
void requireUsable(const KeyBindings& keys)
{
    for (const ActOfKey& one : actsOfKeys()) {
        const auto extra = keys.extraKey(one.act);
        if (extra && (!keys.faultOf(one.act, *extra).isEmpty() || keys.meantBy(*extra) != one.standardKey))
            throw std::runtime_error("a key that clashes was remembered");
        if (keys.keysOf(one.act).isEmpty()) throw std::runtime_error("an act without a key was remembered");
    }
}

void readSettings(const fs::path& file)
{
    setUnreadableAside(QString::fromStdString(file.string()));
    QSettings settings(QString::fromStdString(file.string()), QSettings::IniFormat);
    const KeyBindings keys = rememberedKeys(&settings);
    requireUsable(keys);
    for (const std::string& display : {rememberedDisplay(&settings), std::string("none")})
        if (const auto mmPerPixel = rememberedScale(&settings, display)) {
            if (!(*mmPerPixel > 0 && *mmPerPixel <= largestMmPerPixel))
                throw std::runtime_error("an impossible scale was remembered");
            if (*mmPerPixel < 0.4)
                rendering::testPatternImage({rendering::TestPatternKind::Grating, 1}, cv::Size(64, 2), mmPerPixel);
        }
    recentStudies(&settings);
    rememberKeys(&settings, keys);
    if (rememberedKeys(&settings) != keys) throw std::runtime_error("keys are not read as they were written");
}

}  // namespace

std::vector<Reader> settingsReaders(const fs::path& folder)
{
    qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});  // Qt warns of each value it refuses
    const fs::path file = folder / "vis2hap.ini";
    return {
        {"settings",
         {"[General]\nrecentStudies=/tmp/a, /tmp/b\ndarkRoom=true\ntextPercent=100\n\n[display]\nmmPerPixel=0.05\n"
          "mmPerPixelOf=none\nspecification=none\n\n[extraKeys]\nanswerBegins=16777276\nconfirm=16777239\n",
          "[extraKeys]\nconfirm=65\nvoid=@Variant(\\0\\0\\0\\x2\\0\\0\\0\\x41)\npause=@ByteArray(16777276)\ntouch=1e9\nflag=-1\n",
          "[display]\nspecification=\"exec:driver --port 1\"\nmmPerPixelOf=\"exec:driver --port 1\"\nmmPerPixel=1e-300\n"},
         [file](const std::string& bytes) {
             std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
             readSettings(file);
         }}};
}

}  // namespace fuzz
