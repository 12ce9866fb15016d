" As `dolphin fmt` indents: four columns for each bracket that is open, and for a line that goes on.
if exists('b:did_indent')
  finish
endif
let b:did_indent = 1

setlocal indentexpr=DolphinIndent()
setlocal indentkeys=0{,0},0),0],!^F,o,O,e
setlocal autoindent
let b:undo_indent = 'setlocal indentexpr< indentkeys< autoindent<'

if exists('*DolphinIndent')
  finish
endif

" The line without its strings and its comment.
function! s:code(number) abort
  let line = substitute(getline(a:number), '\v"(\\.|[^"\\])*"|''(\\.|[^''\\])*''', 'x', 'g')
  return substitute(line, '//.*$', '', '')
endfunction

function! s:goes_on(line) abort
  return a:line =~# '\v(\||\&|\>\>|\<\<|[-+*/%^,=?:]|<then|<run|<onError)\s*$'
endfunction

function! DolphinIndent() abort
  let before = prevnonblank(v:lnum - 1)
  if before == 0
    return 0
  endif
  let line = s:code(before)
  let columns = indent(before)
  let opened = len(substitute(line, '[^([{]', '', 'g')) - len(substitute(line, '[^)\]}]', '', 'g'))
  if line =~# '^\s*[)\]}]'
    let opened += 1
  endif
  if opened > 0
    let columns += shiftwidth()
  elseif opened < 0
    let columns += opened * shiftwidth()
  endif
  let above = prevnonblank(before - 1)
  if opened <= 0 && s:goes_on(line)
    if above == 0 || !s:goes_on(s:code(above))
      let columns += shiftwidth()
    endif
  elseif opened <= 0 && above > 0 && s:goes_on(s:code(above)) && s:code(above) !~# ',\s*$'
    let columns -= shiftwidth()
  endif
  if getline(v:lnum) =~# '^\s*[)\]}]'
    let columns -= shiftwidth()
  elseif getline(v:lnum) =~# '\v^\s*(then|run|onError)>'
    let columns += shiftwidth()
  endif
  return max([columns, 0])
endfunction
