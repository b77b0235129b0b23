#include "stage.h"

#include "chart.h"
#include "page.h"

static const char STYLE[] =
    ".head{font-size:1.25rem;line-height:1.35;margin:.5rem 0 .8rem;font-weight:600}"
    "code{font-size:.84rem;overflow-wrap:anywhere}ul{padding-left:1.2rem;margin:.4rem 0}"
    ".warn{color:var(--bad);font-weight:600}"
    ".bars{display:flex;flex-wrap:wrap;gap:.45rem 1rem;margin:.5rem 0}"
    ".bar3{display:flex;flex-wrap:wrap;gap:.3rem}"
    ".bar3 button{font:inherit;font-size:.88rem;color:inherit;background:var(--card);"
    "border:1px solid var(--line);border-radius:.5rem;padding:.34rem .7rem;cursor:pointer;"
    "min-height:2.3rem}"
    ".bar3 button[aria-pressed=true]{background:var(--curve);border-color:var(--curve);"
    "color:var(--back)}"
    ".stage{position:relative;overflow:hidden;border-radius:.5rem;cursor:ew-resize;"
    "touch-action:pan-y;user-select:none;--x:50%;background:#000}"
    ".stage img{display:block;width:100%;height:auto;pointer-events:none}"
    ".stage img+img{position:absolute;inset:0;height:100%;"
    "clip-path:inset(0 0 0 var(--x))}"
    ".stage i{position:absolute;top:0;bottom:0;left:var(--x);width:2px;margin-left:-1px;"
    "background:#fff;box-shadow:0 0 3px #000}"
    ".stage b{position:absolute;bottom:.4rem;padding:.1rem .5rem;border-radius:.4rem;"
    "background:#000a;color:#fff;font-size:.8rem;font-weight:400;max-width:46%}"
    ".stage b:first-of-type{left:.4rem}.stage b:last-of-type{right:.4rem}"
    "input[type=range]{width:100%;margin:.5rem 0;accent-color:var(--curve)}"
    ".two{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(22rem,100%),1fr));"
    "gap:1.2rem}.grid{display:grid;gap:.7rem;margin:.6rem 0;"
    "grid-template-columns:repeat(auto-fill,minmax(min(15rem,46%),1fr))}"
    ".grid img{width:100%;height:auto;display:block;border-radius:.3rem}"
    ".crops{display:grid;gap:.4rem;grid-template-columns:repeat(auto-fill,minmax(min(12rem,45%),"
    "1fr));margin:.3rem 0 1rem}.crops img{width:100%;height:auto;display:block;"
    "image-rendering:pixelated;border-radius:.3rem}"
    ".places{position:relative}.places i{position:absolute;border:2px solid #fff;"
    "outline:1px solid #000;color:#fff;font:600 .8rem system-ui;padding:0 .2rem;"
    "text-shadow:0 0 3px #000,0 0 2px #000}"
    "th{white-space:nowrap}td.n,th.n{text-align:right}td:first-child{white-space:nowrap}"
    ".dot{display:inline-block;width:.7rem;height:.7rem;border-radius:50%;background:var(--c);"
    "margin-right:.4rem}"
    "@media print{:root{color-scheme:light;--back:#fff;--text:#000;--soft:#444;--line:#bbb;"
    "--card:#fff}body{max-width:none;font-size:11pt}.bars,input[type=range]{display:none}"
    "figure,.stage,tr{break-inside:avoid}h2,h3{break-after:avoid}.wide{overflow:visible}"
    "*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}";

/* Chooses what the stage shows; every picture is on the page once, the stage borrows it. */
static const char SCRIPT[] =
    "<script>(function(){var d=document,s=d.getElementById('stage'),r=d.getElementById('split'),"
    "q={m:0,n:s.dataset.n,k:'p'};"
    "function src(i){var e=d.getElementById(i);return e?e.src:''}"
    "function show(){var i='i-'+q.m+'-'+q.n+'-'+q.k,e=d.getElementById(i);if(!e)return;"
    "d.getElementById('over').src=e.src;"
    "d.getElementById('under').src=src('i-ref-'+q.n)||src('i-ref');d.getElementById('what')."
    "textContent=e.alt;"
    "d.querySelectorAll('[data-q]').forEach(function(b){"
    "b.setAttribute('aria-pressed',String(q[b.dataset.q])===b.dataset.v)})}"
    "function split(p){p=Math.max(0,Math.min(100,p));s.style.setProperty('--x',p+'%');r.value=p}"
    "d.querySelectorAll('[data-q]').forEach(function(b){b.onclick=function(){"
    "q[b.dataset.q]=b.dataset.v;show()}});"
    "d.querySelectorAll('.pick').forEach(function(e){e.style.cursor='pointer';e.onclick=function(){"
    "var p=e.id.split('-');q={m:p[1],n:p[2],k:p[3]};show();"
    "d.getElementById('pictures').scrollIntoView({behavior:'smooth'})}});"
    "r.oninput=function(){split(+r.value)};"
    "function drag(e){var b=s.getBoundingClientRect();split(100*(e.clientX-b.left)/b.width)}"
    "s.onpointerdown=function(e){s.setPointerCapture(e.pointerId);drag(e)};"
    "s.onpointermove=function(e){if(e.pointerType==='mouse'||s.hasPointerCapture(e.pointerId))"
    "drag(e)};show()})()</script>\n";

void lobe_app_begin_stage_html(FILE *file, const char *title) {
    char style[sizeof STYLE + 2048];
    snprintf(style, sizeof style, "%s%s", lobe_app_chart_style, STYLE);
    lobe_app_begin_html(file, title, style);
}

void lobe_app_begin_stage_button(FILE *file, char what, const char *value, bool is_on) {
    fprintf(file, "<button data-q=%c data-v=%s aria-pressed=%s>", what, value,
            is_on ? "true" : "false");
}

void lobe_app_write_stage(FILE *file, int n, int width, int height, const char *reference) {
    fprintf(
        file,
        "<div class=stage id=stage data-n=%d><img id=under alt=\"%s\" width=%d height=%d>"
        "<img id=over alt=picture width=%d height=%d><i></i><b>%s</b><b id=what></b></div>"
        "<input type=range id=split min=0 max=100 step=.1 value=50 aria-label=\"the line between "
        "the pictures\">",
        n, reference, width, height, width, height, reference);
}

void lobe_app_write_stage_script(FILE *file) {
    fputs(SCRIPT, file);
}
