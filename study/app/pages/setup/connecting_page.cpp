#include "study/app/pages/setup/connecting_page.h"

#include <QKeyEvent>
#include <QVBoxLayout>

#include "study/app/pieces/page_fit.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

ConnectingPage::ConnectingPage(QWidget* parent)
    : QWidget(parent), m_head(new PageHead(this)), m_stop(mainButton("stopConnectingButton", tr("Stop (Esc)"), this))
{
    setObjectName("connectingPage");
    auto* page = new QWidget(this);
    auto* column = new QVBoxLayout(page);
    column->setSpacing(18);
    column->addWidget(m_head);
    column->addWidget(m_stop, 0, Qt::AlignLeft);
    column->addStretch(1);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    QScrollArea* area = scrolling("connectingArea", page, this);
    constexpr int largest = 200;  // percent; there is nothing else to read
    PageFit::of(*area)->setLargest(largest);
    outer->addWidget(area);
    connect(m_stop, &QPushButton::clicked, this, &ConnectingPage::stopRequested);
}

void ConnectingPage::present(const QString& specification)
{
    m_head->setTexts(tr("Connecting the display…"), tr("%1 has up to 10 seconds to answer.").arg(specification));
    m_stop->setFocus();
}

void ConnectingPage::keyPressEvent(QKeyEvent* event)
{
    if (event->key() == Qt::Key_Escape)
        Q_EMIT stopRequested();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
