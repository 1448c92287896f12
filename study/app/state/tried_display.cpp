#include "study/app/state/tried_display.h"

#include <QSettings>
#include <utility>

#include "study/app/language/below.h"

namespace study::app {

namespace {

const QString displayKey = QStringLiteral("display/specification");
const QString scaleKey = QStringLiteral("display/mmPerPixel");
const QString scaleOfKey = QStringLiteral("display/mmPerPixelOf");

}  // namespace

QString patternName(const TestPattern& pattern) { return inOwnLanguage(rendering::nameOf(pattern)); }

bool leavesPlainImages(const std::string& specification) { return specification.starts_with("folder:"); }

std::string rememberedDisplay(const QSettings* settings)
{
    return settings ? settings->value(displayKey).toString().toStdString() : std::string();
}

void rememberDisplay(QSettings* settings, const std::string& specification)
{
    if (settings) settings->setValue(displayKey, QString::fromStdString(specification));
}

std::optional<double> rememberedScale(const QSettings* settings, const std::string& specification)
{
    if (!settings || settings->value(scaleOfKey).toString().toStdString() != specification) return std::nullopt;
    const double mmPerPixel = settings->value(scaleKey).toDouble();
    return mmPerPixel > 0 && mmPerPixel <= largestMmPerPixel ? std::optional(mmPerPixel) : std::nullopt;
}

void rememberScale(QSettings* settings, const std::string& specification, double mmPerPixel)
{
    if (!settings) return;
    settings->setValue(scaleOfKey, QString::fromStdString(specification));
    settings->setValue(scaleKey, mmPerPixel);
}

TriedDisplay::TriedDisplay(OpenDisplay open, QObject* parent) : QObject(parent), m_opening(std::move(open)) {}

TriedDisplay::~TriedDisplay() { close(); }

void TriedDisplay::connectTo(const std::string& specification)
{
    close();  // A driver serves one connection at a time.
    m_opening.open(
        specification, [this](std::unique_ptr<rendering::HapticDisplay> display) { use(std::move(display)); },
        [this](const QString& fault) { Q_EMIT failed(fault); });
}

void TriedDisplay::use(std::unique_ptr<rendering::HapticDisplay> display)
{
    m_display = std::move(display);
    m_display->onTouched([this](const rendering::Touch&) { Q_EMIT touched(); });
    if (m_display->descriptorToWatch() >= 0) {
        m_watch = std::make_unique<QSocketNotifier>(m_display->descriptorToWatch(), QSocketNotifier::Read);
        connect(m_watch.get(), &QSocketNotifier::activated, this, &TriedDisplay::attend);
    }
    Q_EMIT opened();
}

void TriedDisplay::close()
{
    m_opening.stop();
    try {
        if (m_shown) m_display->clear();
    } catch (const std::exception&) {
        // The connection ends below, and then the driver clears its device.
    }
    m_shown.reset();
    // attend() runs inside the notifier, so the notifier may not be destroyed at once.
    if (m_watch) {
        m_watch->setEnabled(false);
        m_watch.release()->deleteLater();
    }
    m_display.reset();
}

void TriedDisplay::show(const TestPattern& pattern, std::optional<double> mmPerPixel)
{
    const cv::Mat image = rendering::testPatternImage(pattern, m_display->surfacePx(), mmPerPixel);
    try {
        m_shown = pattern;  // A display that fails may show the image nevertheless.
        m_display->show(image);
    } catch (const std::exception&) {
        close();
        throw;
    }
}

void TriedDisplay::clear()
{
    if (!m_shown) return;
    try {
        m_display->clear();
        m_shown.reset();
    } catch (const std::exception&) {
        close();
        throw;
    }
}

void TriedDisplay::attend()
{
    try {
        m_display->processMessages();
    } catch (const std::exception& fault) {
        const QString text = inOwnLanguage(fault.what());
        close();
        Q_EMIT lost(text);
    }
}

}  // namespace study::app
