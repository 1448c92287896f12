#include "study/app/state/screen_cover.h"

#include <QApplication>
#include <QScreen>
#include <QWidget>
#include <charconv>

#include "protocols/files/errors.h"

namespace study::app {

namespace {

constexpr std::string_view coverKind = "cover:";

/// Parts of a specification: "folder:DIR,cover:1" gives "folder:DIR" and "1". Without a cover there is no number. Only the
/// last part can be a cover, because the name of a folder may contain commas.
struct CoverSpecification {
    std::string wrapped;
    std::optional<std::string> screen;
};

CoverSpecification partsOf(const std::string& text)
{
    if (text.starts_with(coverKind)) return {"none", text.substr(coverKind.size())};
    const auto place = text.rfind("," + std::string(coverKind));
    if (place == std::string::npos) return {text, std::nullopt};
    return {text.substr(0, place), text.substr(place + 1 + coverKind.size())};
}

QScreen& screenNumbered(const std::string& number, const std::string& specification)
{
    const auto screens = QGuiApplication::screens();
    qsizetype index = -1;
    const auto [end, fault] = std::from_chars(number.data(), number.data() + number.size(), index);
    const bool isNumber = fault == std::errc() && end == number.data() + number.size();
    const bool isThere = isNumber && index >= 0 && index < screens.size();
    if (isThere && screens.size() > 1) return *screens[index];
    const std::string count = std::to_string(screens.size());
    throw protocols::badInput(
        {.what = isThere ? "covering the only screen would hide the console" : "there is no screen " + number + " to cover",
         .where = "display '" + specification + "'",
         .expected = "a screen other than the console's (screens of this computer: " + count + ", numbered from 0)",
         .nextStep = "connect the screen of the display, or leave \"cover\" out and stamp touches with the key T"});
}

}  // namespace

class ScreenCover::Window final : public QWidget {
public:
    explicit Window(QScreen& screen)
        : QWidget(nullptr, Qt::Window | Qt::FramelessWindowHint | Qt::WindowStaysOnTopHint | Qt::WindowDoesNotAcceptFocus)
    {
        setObjectName("screenCover");
        setAccessibleName(QCoreApplication::translate("study::app::ScreenCover", "Cover of the haptic display"));
        setAttribute(Qt::WA_AcceptTouchEvents);
        setAttribute(Qt::WA_ShowWithoutActivating);  // the console keeps the keyboard
        setAttribute(Qt::WA_QuitOnClose, false);
        setAttribute(Qt::WA_StyledBackground);
        setStyleSheet(QStringLiteral("#screenCover { background: black; }"));
        setCursor(Qt::BlankCursor);
        setScreen(&screen);
        setGeometry(screen.geometry());
        // Qt moves the window of an unplugged screen to another screen, where it would cover the console.
        connect(qApp, &QGuiApplication::screenRemoved, this, [this, covered = &screen](const QScreen* removed) {
            isScreenGone = isScreenGone || removed == covered;
            setVisible(!isScreenGone);
        });
        showFullScreen();
    }

    std::function<void(const rendering::Touch&)> touched;
    bool isScreenGone = false;

protected:
    bool event(QEvent* event) override
    {
        const bool isTouch = event->type() == QEvent::TouchBegin || event->type() == QEvent::MouseButtonPress ||
                             event->type() == QEvent::MouseButtonDblClick;
        if (!isTouch) return QWidget::event(event);
        event->accept();  // otherwise the touch arrives a second time as a mouse press
        if (touched) touched({});
        return true;
    }
};

ScreenCover::ScreenCover(std::unique_ptr<rendering::HapticDisplay> wrapped, QScreen& screen)
    : m_wrapped(std::move(wrapped)), m_window(std::make_unique<Window>(screen))
{
}

ScreenCover::~ScreenCover() = default;

void ScreenCover::show(const cv::Mat& frictionImage)
{
    if (m_window->isScreenGone)
        throw protocols::workFailed({.what = "the screen of the display was disconnected",
                                     .where = name(),
                                     .expected = "a connected screen during the whole session",
                                     .nextStep = "connect the screen, press Q to stop, and open the session again"});
    m_wrapped->show(frictionImage);
}

std::string ScreenCover::name() const { return m_wrapped->name() + " under a covered screen"; }

void ScreenCover::onTouched(std::function<void(const rendering::Touch&)> touched)
{
    m_wrapped->onTouched(touched);
    m_window->touched = std::move(touched);
}

std::unique_ptr<rendering::HapticDisplay> openDisplay(const std::string& specification, const std::stop_token& stop)
{
    withCover(nullptr, specification);  // A wrong screen is reported before a driver is started.
    return withCover(rendering::openDisplay(coveredDisplay(specification), stop), specification);
}

std::string coveredDisplay(const std::string& specification) { return partsOf(specification).wrapped; }

std::unique_ptr<rendering::HapticDisplay> withCover(std::unique_ptr<rendering::HapticDisplay> display,
                                                    const std::string& specification)
{
    const CoverSpecification parts = partsOf(specification);
    if (!parts.screen) return display;
    QScreen& screen = screenNumbered(*parts.screen, specification);
    if (!display) return nullptr;
    return std::make_unique<ScreenCover>(std::move(display), screen);
}

}  // namespace study::app
