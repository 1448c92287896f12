#include "study/app/state/screen_cover.h"

#include <QApplication>
#include <QScreen>
#include <QWidget>
#include <charconv>

#include "protocols/files/errors.h"

namespace study::app {

namespace {

constexpr std::string_view coverKind = "cover:";

/// "folder:DIR,cover:1" -> "folder:DIR" and "1"; no number where no screen is to be covered. A folder's name may hold
/// commas: only the last part counts.
struct Specification {
    std::string felt;
    std::optional<std::string> screen;
};

Specification partsOf(const std::string& text)
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
         .expected = "a screen beside the console's; this computer has " + count + ", counted from 0",
         .nextStep = "connect the display's screen, or leave \"cover\" out and stamp touches by key T"});
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
        setAttribute(Qt::WA_ShowWithoutActivating);  // the keys stay the console's
        setAttribute(Qt::WA_QuitOnClose, false);
        setAttribute(Qt::WA_StyledBackground);
        setStyleSheet(QStringLiteral("#screenCover { background: black; }"));
        setCursor(Qt::BlankCursor);
        setScreen(&screen);
        setGeometry(screen.geometry());
        // A window of a screen that is unplugged would come to lie over the console.
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
        event->accept();  // else the system would make a mouse press of a finger's touch
        if (touched) touched({});
        return true;
    }
};

ScreenCover::ScreenCover(std::unique_ptr<rendering::HapticDisplay> felt, QScreen& screen)
    : m_felt(std::move(felt)), m_window(std::make_unique<Window>(screen))
{
}

ScreenCover::~ScreenCover() = default;

void ScreenCover::show(const cv::Mat& frictionImage)
{
    if (m_window->isScreenGone)
        throw protocols::workFailed({.what = "the screen of the display is gone",
                                     .where = name(),
                                     .expected = "it to stay connected",
                                     .nextStep = "connect it, stop with Q and open the session again"});
    m_felt->show(frictionImage);
}

std::string ScreenCover::name() const { return m_felt->name() + " under a covered screen"; }

void ScreenCover::onTouched(std::function<void(const rendering::Touch&)> touched)
{
    m_felt->onTouched(touched);
    m_window->touched = std::move(touched);
}

std::unique_ptr<rendering::HapticDisplay> openDisplay(const std::string& specification)
{
    const Specification parts = partsOf(specification);
    if (!parts.screen) return rendering::openDisplay(parts.felt);
    QScreen& screen = screenNumbered(*parts.screen, specification);
    return std::make_unique<ScreenCover>(rendering::openDisplay(parts.felt), screen);
}

}  // namespace study::app
