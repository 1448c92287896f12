#include "study/app/pieces/appearance_keys.h"

#include <QApplication>
#include <QEvent>
#include <QShortcut>
#include <QVariant>
#include <QWidget>

#include "study/app/pieces/page_fit.h"
#include "study/app/state/recent_studies.h"

namespace study::app {

namespace {

/// Shared by all windows: the style of the application is one.
constexpr char sizeName[] = "vis2hapMainWindow";
constexpr char fontName[] = "vis2hapFont";

/// Size of the main window, from which all windows take their scale.
QSize mainWindowSize()
{
    const QVariant size = qApp->property(sizeName);
    return size.isValid() ? size.toSize() : QSize(0, 0);
}

/// The font before any appearance was applied: a second window must not enlarge what the first has enlarged.
QFont originalFont()
{
    if (!qApp->property(fontName).isValid()) qApp->setProperty(fontName, QApplication::font());
    return qApp->property(fontName).value<QFont>();
}

}  // namespace

AppearanceKeys::AppearanceKeys(std::shared_ptr<QSettings> settings, QWidget& window, Growth growth)
    : QObject(&window),
      m_settings(std::move(settings)),
      m_window(window),
      m_base(originalFont()),
      m_appearance(rememberedAppearance(m_settings.get()))
{
    const auto bind = [&](const QKeySequence& keys, auto work) {
        connect(new QShortcut(keys, &window), &QShortcut::activated, this, work);
    };
    bind(QKeySequence(Qt::CTRL | Qt::Key_Plus), [this] { enlarge(); });
    bind(QKeySequence(Qt::CTRL | Qt::Key_Equal), [this] { enlarge(); });
    bind(QKeySequence(Qt::CTRL | Qt::Key_Minus), [this] { reduce(); });
    bind(QKeySequence(Qt::CTRL | Qt::Key_0), [this] { set({m_appearance.theme, 100}); });
    bind(QKeySequence(Qt::CTRL | Qt::Key_D), [this] { changeTheme(); });
    // A monitor of its own program has no main window, so its text grows with the monitor itself.
    if (growth == Growth::WithWindow || !qApp->property(sizeName).isValid()) {
        qApp->setProperty(sizeName, window.size());
        window.installEventFilter(this);
    }
    applyAppearance(m_appearance, m_base, mainWindowSize());
}

void AppearanceKeys::set(const Appearance& appearance)
{
    m_appearance = appearance;
    applyAppearance(appearance, m_base, mainWindowSize());
    rememberAppearance(m_settings.get(), appearance);
}

/// A size that the window cannot show looks like the one before it, so it is passed over.
void AppearanceKeys::takeNextSize(Appearance (*next)(Appearance))
{
    const auto shown = [](const Appearance& appearance) { return textScaleOf(mainWindowSize(), appearance.textPercent); };
    Appearance wanted = next(m_appearance);
    while (shown(wanted) == shown(m_appearance) && next(wanted) != wanted) wanted = next(wanted);
    if (shown(wanted) != shown(m_appearance)) set(wanted);
}

bool AppearanceKeys::eventFilter(QObject* watched, QEvent* event)
{
    // Queued, because the new style must not arrive while the layout of the old one is computed.
    if (event->type() == QEvent::Resize)
        QMetaObject::invokeMethod(
            this, [this] { grow(); }, Qt::QueuedConnection);
    return QObject::eventFilter(watched, event);
}

void AppearanceKeys::grow()
{
    qApp->setProperty(sizeName, m_window.size());
    applyAppearance(m_appearance, m_base, m_window.size());
    if (m_window.layout()) scaleGaps(*m_window.layout(), scaleOf(m_window.size()));
}

}  // namespace study::app
