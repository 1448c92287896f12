#include "study/app/pages/setup/keys_page.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QSettings>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "study/app/pages/stage_page.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

constexpr int actColumn = 0, extraColumn = 2;

QString wordsOfAct(KeyAct act)
{
    for (const ActOfKey& one : actsOfKeys())
        if (one.act == act) return one.words;
    return {};
}

}  // namespace

KeysPage::KeysPage(std::shared_ptr<QSettings> settings, QWidget* parent)
    : QWidget(parent),
      m_settings(std::move(settings)),
      m_keys(rememberedKeys(m_settings.get())),
      m_acts(new QTreeWidget(this)),
      m_assign(mainButton("assignKeyButton", tr("Press another key… (Enter)"), this)),
      m_remove(button("removeKeyButton", tr("Remove the other key (Delete)"), this)),
      m_reset(button("resetKeysButton", tr("Remove all other keys"), this)),
      m_latency(button("latencyTaskButton", tr("Measure the latency of the operator…"), this)),
      m_back(plainButton("keysBackButton", tr("Back (Esc)"), this)),
      m_message(new MessageBar("keysMessage", this))
{
    setObjectName("keysPage");
    setFocusPolicy(Qt::ClickFocus);
    build();
    connect(m_assign, &QPushButton::clicked, this, &KeysPage::waitForKey);
    connect(m_acts, &QTreeWidget::itemDoubleClicked, this, &KeysPage::waitForKey);  // Enter comes through the page
    connect(m_remove, &QPushButton::clicked, this, &KeysPage::removeKey);
    connect(m_reset, &QPushButton::clicked, this, &KeysPage::resetAll);
    connect(m_latency, &QPushButton::clicked, this, &KeysPage::latencyTaskRequested);
    connect(m_back, &QPushButton::clicked, this, &KeysPage::backRequested);
    showKeys();
}

void KeysPage::build()
{
    name(*m_acts, "actsList", tr("Acts of a session and their keys"));
    setType(*m_acts, Type::Body);
    m_acts->setRootIsDecorated(false);
    m_acts->setAllColumnsShowFocus(true);
    m_acts->setHeaderLabels({tr("Act"), tr("Key"), tr("Other key")});
    m_acts->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_acts->header()->setStretchLastSection(true);
    m_acts->header()->setFocusPolicy(Qt::NoFocus);
    for (const ActOfKey& one : actsOfKeys()) {
        auto* row = new QTreeWidgetItem(m_acts, {one.words, nameOfKey(one.standardKey)});
        row->setData(actColumn, Qt::UserRole, static_cast<int>(one.act));
    }
    m_acts->setCurrentItem(m_acts->topLevelItem(0));
    auto* page = new QWidget(this);
    auto* head = new PageHead(page);
    head->setTexts(tr("Keys and pedals"),
                   tr("A foot pedal is a keyboard with one key. Give its key to an act. The usual key acts as well."));
    auto* fixed = quietLabel("fixedKeys", page);
    fixed->setText(
        tr("Fixed keys: letters choose a piece, digits and the point enter a number, Tab moves between the controls, "
           "Page Up and Page Down scroll. A barcode scanner enters the codes of pieces on the page of the tray. The "
           "Enter of a scanner stores no answer."));
    auto* column = new QVBoxLayout(page);
    column->setSpacing(10);
    column->addWidget(head);
    column->addWidget(m_acts, 1);
    column->addWidget(m_message);
    column->addLayout(actionsRow({m_assign, m_remove, m_reset, m_latency, m_back}));
    column->addWidget(fixed);
    column->addWidget(appearanceHint(page));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("keysArea", page, this));
    m_acts->setMinimumHeight(m_acts->fontMetrics().height() * 12);
}

void KeysPage::present()
{
    m_waiting.reset();
    m_message->clearMessage();
    showKeys();
}

void KeysPage::offerLatencyTask(bool isOffered) { m_latency->setVisible(isOffered); }

void KeysPage::focusFirst() { m_acts->setFocus(); }

std::optional<KeyAct> KeysPage::chosenAct() const
{
    const QTreeWidgetItem* row = m_acts->currentItem();
    return row ? std::optional(static_cast<KeyAct>(row->data(actColumn, Qt::UserRole).toInt())) : std::nullopt;
}

void KeysPage::waitForKey()
{
    m_waiting = chosenAct();
    if (!m_waiting) return;
    setFocus();
    m_message->showHint(tr("Press the key or the pedal for “%1” now. Esc changes nothing.").arg(wordsOfAct(*m_waiting)));
}

void KeysPage::take(int key)
{
    const KeyAct act = *m_waiting;
    if (key == Qt::Key_Escape) {
        m_waiting.reset();
        m_message->showHint(tr("Nothing is changed."));
        return focusFirst();
    }
    if (const QString fault = m_keys.bind(act, key); !fault.isEmpty()) return m_message->showHint(fault);  // it still waits
    m_waiting.reset();
    rememberKeys(m_settings.get(), m_keys);
    showKeys();
    const bool scrolls = key == Qt::Key_PageDown || key == Qt::Key_PageUp;
    m_message->showDone(tr("%1 now acts as “%2” in every session.").arg(nameOfKey(key), wordsOfAct(act)) +
                        (scrolls ? tr(" It does not scroll in a session any more.") : QString()));
    focusFirst();
}

void KeysPage::removeKey()
{
    const auto act = chosenAct();
    if (!act || !m_keys.extraKey(*act)) return m_message->showHint(tr("This act has no other key."));
    m_keys.unbind(*act);
    rememberKeys(m_settings.get(), m_keys);
    showKeys();
    m_message->showDone(tr("“%1” has only its usual key now.").arg(wordsOfAct(*act)));
}

void KeysPage::resetAll()
{
    m_keys = {};
    rememberKeys(m_settings.get(), m_keys);
    showKeys();
    m_message->showDone(tr("Every act has only its usual key now."));
}

void KeysPage::showKeys()
{
    for (int place = 0; place < m_acts->topLevelItemCount(); ++place) {
        QTreeWidgetItem* row = m_acts->topLevelItem(place);
        const auto extra = m_keys.extraKey(static_cast<KeyAct>(row->data(actColumn, Qt::UserRole).toInt()));
        row->setText(extraColumn, extra ? nameOfKey(*extra) : tr("–"));
    }
}

void KeysPage::keyPressEvent(QKeyEvent* event)
{
    if (m_waiting) {
        if (!event->isAutoRepeat()) take(event->key());
        return;
    }
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    if (event->key() == Qt::Key_Escape)
        Q_EMIT backRequested();
    else if (event->key() == Qt::Key_Delete)
        removeKey();
    else if (isEnter(event->key()) && pressed)
        pressed->click();
    else if (isEnter(event->key()))
        waitForKey();
    else
        QWidget::keyPressEvent(event);
}

bool KeysPage::focusNextPrevChild(bool next) { return m_waiting ? false : QWidget::focusNextPrevChild(next); }

void KeysPage::hideEvent(QHideEvent* event)
{
    QWidget::hideEvent(event);
    m_waiting.reset();
}

}  // namespace study::app
