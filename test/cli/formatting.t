A file is laid out in one way, and named if it was not.

  $ cat > mission.dol <<END
  > v=pick{count 2
  >   type 'UUV'}   // both
  > 
  > 
  > execute watch imcPlan( 'survey' )
  >   onError { err-> message "\${ err }"; ignore() }
  > END
  $ cp mission.dol before.dol
  $ dolphin fmt mission.dol
  mission.dol
  $ cat mission.dol
  v = pick {
      count 2
      type 'UUV'
  } // both
  
  execute watch imcPlan('survey')
      onError { err -> message "${ err }"; ignore() }
  $ dolphin fmt mission.dol

Standard input goes to standard output.

  $ dolphin fmt < before.dol | diff - mission.dol

A check changes nothing.

  $ cp before.dol again.dol
  $ dolphin fmt --check again.dol mission.dol
  again.dol
  [1]
  $ cmp again.dol before.dol
  $ dolphin fmt --check - < before.dol
  standard input
  [1]
  $ dolphin fmt --check - < mission.dol

A file with errors stays, and others are formatted.

  $ echo "execute (" > bad.dol
  $ dolphin fmt bad.dol again.dol missing.dol
  bad.dol:1:9: error: this '(' is never closed
    1 | execute (
      |         ^
      hint: a ')' is missing
  again.dol
  dolphin: missing.dol: No such file or directory
  [2]
  $ cat bad.dol
  execute (

A link stays one, and permissions stay.

  $ cp before.dol target.dol && chmod 640 target.dol && ln -s target.dol link.dol
  $ dolphin fmt link.dol
  link.dol
  $ test -L link.dol && cmp target.dol mission.dol && stat -c %a target.dol
  640
  $ ls -A | grep '^.dolphin-fmt'
  [1]

Folders stand for the programs and fleets in them: all of this project are formatted.

  $ dolphin fmt --check ../../examples
  $ dolphin new started > /dev/null
  $ dolphin fmt --check started
