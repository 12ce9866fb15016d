if exists('b:current_syntax')
  finish
endif

syntax keyword dolphinConditional if else
syntax keyword dolphinRepeat while for in break continue
syntax keyword dolphinStatement def return
syntax match dolphinStatement '\v^\s*\zsparameter\ze\s+\h\w*\s*\='
syntax keyword dolphinOperatorWord allOf when then oneOf choose waitFor until assure during within run watch onError
syntax keyword dolphinOperatorWord repeat recruit ensure using
syntax keyword dolphinBoolean true false
syntax keyword dolphinConstant null _
syntax keyword dolphinTask task imcPlan action condition assert idle confirm fresh mission pick pos
syntax keyword dolphinProcedure ignore propagate retry dismiss fail post consume poll message println release
syntax keyword dolphinProcedure setConnectionTimeout ask pause getSupplier execute input halt onInterrupt position
syntax keyword dolphinProcedure battery progress speed connected reading running now timeOfDay eta isNumber isString
syntax keyword dolphinProcedure isList isMap location polygon map fence corridor along coverage expandingSquare
syntax keyword dolphinProcedure sector spiral footprint area
syntax keyword dolphinFleet vehicle plan answer reply field

syntax match dolphinNumber '\v<\d[0-9_]*(\.\d[0-9_]*)?([eE][-+]?\d+)?>'
syntax match dolphinNumber '\v<0x\x+>'
syntax match dolphinOperator '>>\|<<\|||\|&&\|->\|?:\|?\.\|\.\.<\?\|[|&^!<>=+*%?:-]'
syntax match dolphinEscape contained '\\\([nrtbf\\''"$]\|u\x\{4}\)'
syntax match dolphinHole contained '\$\h\w*\(\.\h\w*\)*'
syntax region dolphinHole contained matchgroup=dolphinDelimiter start='\${' end='}' contains=TOP
syntax region dolphinString start="'" end="'" skip='\\.' oneline contains=dolphinEscape
syntax region dolphinString start='"' end='"' skip='\\.' oneline contains=dolphinEscape,dolphinHole
syntax region dolphinString start="'''" end="'''" skip='\\.' contains=dolphinEscape
syntax region dolphinString start='"""' end='"""' skip='\\.' contains=dolphinEscape,dolphinHole
syntax match dolphinKey '\v<\h\w*\ze\s*:'
syntax match dolphinFunction '\v(<def\s+)@<=\h\w*\ze\s*\('
syntax keyword dolphinTodo contained TODO FIXME
syntax match dolphinComment '//.*$' contains=dolphinTodo,@Spell
syntax region dolphinComment start='/\*' end='\*/' contains=dolphinTodo,@Spell

syntax sync minlines=200

highlight default link dolphinConditional Conditional
highlight default link dolphinRepeat Repeat
highlight default link dolphinStatement Keyword
highlight default link dolphinOperatorWord Keyword
highlight default link dolphinBoolean Boolean
highlight default link dolphinConstant Constant
highlight default link dolphinTask Function
highlight default link dolphinProcedure Function
highlight default link dolphinFleet Structure
highlight default link dolphinNumber Number
highlight default link dolphinOperator Operator
highlight default link dolphinEscape SpecialChar
highlight default link dolphinHole Special
highlight default link dolphinDelimiter Delimiter
highlight default link dolphinString String
highlight default link dolphinKey Identifier
highlight default link dolphinFunction Function
highlight default link dolphinTodo Todo
highlight default link dolphinComment Comment

let b:current_syntax = 'dolphin'
