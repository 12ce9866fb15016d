(* The grammar of programs, over the tokens that [Layout] hands on: newlines are gone or are SEPARATOR, a name
   that is called without parentheses is COMMAND, and an opening brace says what it opens. *)

%{
open Ast
open Node

let expression place it = located place it
%}

%token <string> NAME
%token <string> COMMAND                  (* a name with an argument after it: [message 'x'] *)
%token <Ast.builder> BUILDER             (* [pick], [imcPlan] ... before a brace *)
%token <int> INTEGER
%token <float> NUMBER
%token <string> STRING
%token TEMPLATE_OPEN TEMPLATE_CLOSE HOLE_OPEN HOLE_CLOSE
%token <string> TEXT
%token WILDCARD TRUE FALSE NULL
%token PARAMETER                         (* before [n = 3] at the start of a statement *)
%token RECRUIT                           (* before a brace *)
%token OTHERWISE                         (* the [else] of a [pick] *)
%token DEF IF ELSE WHILE FOR IN RETURN BREAK CONTINUE
%token WHEN WATCH WAIT_FOR REPEAT THEN RUN ON_ERROR
%token <Ast.on_cut> UNTIL DURING         (* [until] and [during] complete; [assure] and [within] fail *)
%token <Ast.on_cut> AFTER_UNTIL AFTER_DURING    (* after a task: [T until { C }], [T during D] *)
%token LPAREN RPAREN LBRACKET RBRACKET RBRACE
%token LBRACE                            (* opens a closure *)
%token TRAILING                          (* opens a closure after a call: [f(x) {] *)
%token BLOCK                             (* opens statements: a body, a builder's settings *)
%token SEPARATOR COMMA COLON ARROW DOT SAFE_DOT QUESTION ELVIS
%token ASSIGN
%token <Ast.binary> ASSIGN_OPERATOR
%token <int> STEP                        (* [++] is 1, [--] is -1 *)
%token RANGE RANGE_LESS
%token POWER STAR SLASH PERCENT PLUS MINUS SHIFT_LEFT SHIFT_RIGHT
%token LESS LESS_EQUAL GREATER GREATER_EQUAL EQUAL NOT_EQUAL
%token AMPERSAND CARET BAR AND OR NOT
%token EOF

(* From loosest to tightest. A comma behind [repeat N] is its own. *)
%nonassoc repeated
%nonassoc COMMA
%nonassoc no_else
%nonassoc ELSE
%nonassoc whole_expression
%nonassoc AFTER_UNTIL AFTER_DURING
%right QUESTION ELVIS
%left OR
%left AND
%left BAR
%left CARET
%left AMPERSAND
%left EQUAL NOT_EQUAL
%left LESS LESS_EQUAL GREATER GREATER_EQUAL IN
%left SHIFT_LEFT SHIFT_RIGHT RANGE RANGE_LESS
%left PLUS MINUS
%left STAR SLASH PERCENT
%nonassoc NOT
%left POWER

%start <Ast.program> program
%start <Ast.expression> answer

%%

program:
  | body = statements; EOF { body }

answer:
  | e = chain; EOF { e }

(* Statements *)

statements:
  | { [] }
  | reversed = some_statements { List.rev reversed }

some_statements:
  | s = statement { [ s ] }
  | rest = some_statements; SEPARATOR; s = statement { s :: rest }

statement:
  | s = simple_statement { s }
  | BLOCK; body = statements; RBRACE { located $loc (Block body) }

simple_statement:
  | e = chain
    { located $loc (Expression e) }
  | target = postfix; ASSIGN; value = chain
    { located $loc (Assign { target; operator = None; value }) }
  | target = postfix; operator = ASSIGN_OPERATOR; value = chain
    { located $loc (Assign { target; operator = Some operator; value }) }
  | DEF; x = name
    { located $loc (Define (x, None)) }
  | DEF; x = name; ASSIGN; value = chain
    { located $loc (Define (x, Some value)) }
  | DEF; name = name; LPAREN; parameters = parameters; RPAREN; BLOCK; body = statements; RBRACE
    { located $loc (Function { name; parameters; body }) }
  | PARAMETER; name = name; ASSIGN; value = item; description = option(description)
    { located $loc (Parameter { name; value = settle value; description }) }
  | IF; LPAREN; condition = chain; RPAREN; body = body                       %prec no_else
    { located $loc (If (condition, body, [])) }
  | IF; LPAREN; condition = chain; RPAREN; body = body; ELSE; otherwise = body
    { located $loc (If (condition, body, otherwise)) }
  | WHILE; LPAREN; condition = chain; RPAREN; body = body
    { located $loc (While (condition, body)) }
  | FOR; LPAREN; x = name; IN; e = chain; RPAREN; body = body
  | FOR; LPAREN; DEF; x = name; IN; e = chain; RPAREN; body = body
    { located $loc (For (x, e, body)) }
  | RETURN
    { located $loc (Return None) }
  | RETURN; e = chain
    { located $loc (Return (Some e)) }
  | BREAK
    { located $loc Break }
  | CONTINUE
    { located $loc Continue }
  | x = name; COLON; e = chain
    { located $loc (Setting (x, e)) }

description:
  | COMMA; text = STRING { located $loc(text) text }

body:
  | BLOCK; body = statements; RBRACE { body }
  | s = simple_statement { [ s ] }

name:
  | x = NAME { located $loc x }

parameters:
  | { [] }
  | reversed = some_parameters { List.rev reversed }

some_parameters:
  | x = name { [ x ] }
  | rest = some_parameters; COMMA; x = name { x :: rest }

(* Whole expressions: a command takes all its arguments in a chain, one in an item. *)

chain:
  | e = plain { settle e }
  | e = command { settle e }

item:
  | e = plain                                                                %prec whole_expression { e }
  | callee = commanded; a = argument_item { command $loc callee [ a ] }

plain:
  | e = expression                                                           %prec whole_expression { item e }
  | e = plain; on_cut = AFTER_DURING; duration = expression { limit e (During_limit (on_cut, duration)) $endpos }
  | e = plain; on_cut = AFTER_UNTIL; c = closure { limit e (Until_limit (on_cut, c)) $endpos }

command:
  | callee = commanded; reversed = command_arguments { command $loc callee reversed }

  | callee = applicable; first = leading_closure; COMMA; reversed = command_arguments
    { command $loc callee (reversed @ [ first ]) }

(* [assert { C }, 'text']: the closure is the first of several arguments. *)
leading_closure:
  | c = trailing { Positional_item (item c) }

commanded:
  | x = COMMAND
    { expression $loc (Variable x) }
  | subject = postfix; DOT; name = command_name
    { expression $loc (Member { subject; name; safe = false }) }
  | subject = postfix; SAFE_DOT; name = command_name
    { expression $loc (Member { subject; name; safe = true }) }

command_name:
  | x = COMMAND { located $loc x }

command_arguments:
  | a = command_argument { [ a ] }
  | rest = command_arguments; COMMA; a = command_argument { a :: rest }

argument_item:
  | e = item { Positional_item e }

command_argument:
  | a = argument_item { a }
  | k = argument_key; COLON; e = item { Named_item (k, e) }
  | k = computed_key; COLON; e = item { Keyed_item (k, e) }

computed_key:
  | t = template { t }
  | e = parenthesised { e }

argument_key:
  | k = NAME | k = STRING { located $loc k }
  | WILDCARD { located $loc "_" }

(* Expressions *)

expression:
  | e = postfix
    { e }
  | target = postfix; by = STEP
    { expression $loc (Increment { target; by; prefix = false }) }
  | by = STEP; target = postfix
    { expression $loc (Increment { target; by; prefix = true }) }
  | NOT; e = expression
    { expression $loc (Unary (Not, e)) }
  | MINUS; e = expression                                                    %prec NOT
    { expression $loc (Unary (Negate, e)) }
  | PLUS; e = expression                                                     %prec NOT
    { e }
  | a = expression; o = operator; b = expression
    { expression $loc (Binary (o, a, b)) }
  | first = expression; RANGE; last = expression
    { expression $loc (Range { first; last; inclusive = true }) }
  | first = expression; RANGE_LESS; last = expression
    { expression $loc (Range { first; last; inclusive = false }) }
  | c = expression; QUESTION; a = expression; COLON; b = expression          %prec QUESTION
    { expression $loc (Conditional (c, a, b)) }
  | a = expression; ELVIS; b = expression
    { expression $loc (Elvis (a, b)) }
  | WHEN; c = closure; THEN; t = item
    { expression $loc (When (c, settle t)) }
  | WAIT_FOR; c = closure; THEN; t = item
  | WAIT_FOR; c = closure; RUN; t = item
    { expression $loc (Wait_for (c, settle t)) }
  | on_cut = UNTIL; c = closure; RUN; t = item
    { expression $loc (Until (on_cut, c, settle t)) }
  | on_cut = DURING; d = item; RUN; t = item
    { expression $loc (During (on_cut, settle d, settle t)) }
  | RECRUIT; BLOCK; settings = statements; RBRACE; THEN; c = closure
    { expression $loc (Recruit (settings, c)) }
  | WATCH; t = item; ON_ERROR; c = closure
    { expression $loc (Watch (settle t, c)) }
  | REPEAT; t = item                                                         %prec repeated
    { repeat $loc None t }
  | REPEAT; n = item; COMMA; t = item
    { repeat $loc (Some (settle n)) t }

%inline operator:
  | POWER { Power }
  | STAR { Multiply }
  | SLASH { Divide }
  | PERCENT { Remainder }
  | PLUS { Add }
  | MINUS { Subtract }
  | SHIFT_LEFT { Append }
  | SHIFT_RIGHT { Sequence }
  | LESS { Less }
  | LESS_EQUAL { Less_equal }
  | GREATER { Greater }
  | GREATER_EQUAL { Greater_equal }
  | IN { Member_of }
  | EQUAL { Equal }
  | NOT_EQUAL { Not_equal }
  | AMPERSAND { Intersect }
  | CARET { Around }
  | BAR { Parallel }
  | AND { And }
  | OR { Or }

postfix:
  | e = applicable { e }
  | e = invocation { e }

applicable:
  | e = primary
    { e }
  | subject = postfix; DOT; name = name
    { expression $loc (Member { subject; name; safe = false }) }
  | subject = postfix; SAFE_DOT; name = name
    { expression $loc (Member { subject; name; safe = true }) }
  | e = postfix; LBRACKET; i = chain; RBRACKET
    { expression $loc (Index (e, i)) }

invocation:
  | callee = postfix; LPAREN; arguments = arguments; RPAREN
    { expression $loc (Call { callee; arguments }) }
  | call = invocation; c = trailing
    { trailing $loc call c }
  | callee = applicable; c = trailing
    { expression $loc (Call { callee; arguments = [ Positional c ] }) }

trailing:
  | TRAILING; c = closure_rest { expression $loc (Closure c) }

arguments:
  | { [] }
  | reversed = some_arguments; option(COMMA) { List.rev_map argument reversed }

some_arguments:
  | a = command_argument { [ a ] }
  | rest = some_arguments; COMMA; a = command_argument { a :: rest }

closure:
  | LBRACE; c = closure_rest { c }

closure_rest:
  | body = statements; RBRACE { { parameters = None; body } }
  | parameters = parameters; ARROW; body = statements; RBRACE { { parameters = Some parameters; body } }

primary:
  | NULL { expression $loc Null }
  | TRUE { expression $loc (Boolean true) }
  | FALSE { expression $loc (Boolean false) }
  | n = INTEGER { expression $loc (Integer n) }
  | n = NUMBER { expression $loc (Number n) }
  | s = STRING { expression $loc (String s) }
  | t = template { t }
  | x = NAME { expression $loc (Variable x) }
  | WILDCARD { expression $loc Wildcard }
  | e = parenthesised { e }
  | LBRACKET; RBRACKET { expression $loc (List []) }
  | LBRACKET; reversed = items; option(COMMA); RBRACKET { expression $loc (List (List.rev reversed)) }
  | LBRACKET; COLON; RBRACKET { expression $loc (Map []) }
  | LBRACKET; reversed = entries; option(COMMA); RBRACKET { expression $loc (Map (List.rev reversed)) }
  | c = closure { expression $loc (Closure c) }
  | b = BUILDER; BLOCK; body = statements; RBRACE { expression $loc (Builder (b, body)) }
  | BUILDER; BLOCK; settings = statements; RBRACE; OTHERWISE; BLOCK; otherwise = statements; RBRACE
    { expression $loc (Pick_else (settings, otherwise)) }

parenthesised:
  | LPAREN; e = chain; RPAREN { { e with at = Location.make $loc } }

items:
  | e = item { [ settle e ] }
  | rest = items; COMMA; e = item { settle e :: rest }

entries:
  | e = entry { [ e ] }
  | rest = entries; COMMA; e = entry { e :: rest }

entry:
  | k = key; COLON; e = item { located $loc(k) k, settle e }

key:
  | k = NAME | k = STRING { Name k }
  | n = INTEGER { Computed (expression $loc (Integer n)) }
  | n = NUMBER { Computed (expression $loc (Number n)) }
  | TRUE { Computed (expression $loc (Boolean true)) }
  | FALSE { Computed (expression $loc (Boolean false)) }
  | WILDCARD { Name "_" }
  | t = template { Computed t }
  | e = parenthesised { Computed e }

template:
  | TEMPLATE_OPEN; reversed = parts; TEMPLATE_CLOSE { expression $loc (Template (List.rev reversed)) }

parts:
  | { [] }
  | rest = parts; text = TEXT { Literal text :: rest }
  | rest = parts; HOLE_OPEN; e = chain; HOLE_CLOSE { Hole e :: rest }
