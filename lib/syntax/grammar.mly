(* The grammar of programs, over the tokens that [Layout] hands on: newlines are gone or are SEPARATOR, a name that
   is called without parentheses is COMMAND, and an opening brace has its construct. *)

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
%token ENSURE                            (* after a task: [T ensure { a }] *)
%token USING
%token <Ast.on_cut> UNTIL DURING         (* [until] and [during] complete; [assure] and [within] fail *)
%token AFTER_UNTIL AFTER_ASSURE          (* after a task: [T until { C }], [T assure { C }] *)
%token <Ast.on_cut> AFTER_DURING         (* the same for [T during D], [T within D] *)
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
%token NEVER                             (* in no text: see [rounds] *)
%token EOF

(* From loosest to tightest. A comma behind [repeat N] is its own. *)
%nonassoc repeated
%nonassoc COMMA
%nonassoc no_else
%nonassoc ELSE
%nonassoc whole_expression
%nonassoc AFTER_UNTIL
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
  | PARAMETER; name = name; ASSIGN; value = item(any_limit); description = option(description)
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

(* Whole expressions: a command takes all its arguments in a chain, one in an item. [limit] is the postfix forms of a
   task: [inner_limit] in the rounds of a [repeat], where an [until] is the repeat's, [any_limit] elsewhere. *)

chain:
  | e = expression(any_limit) { settle e }
  | e = command { settle e }

item(limit):
  | e = expression(limit)                                                    %prec whole_expression { e }
  | callee = commanded; a = argument_item(limit) { command $loc callee [ a ] }

any_limit:
  | l = inner_limit { l }
  | AFTER_UNTIL; c = closure { Until_limit (Completes, c) }

inner_limit:
  | on_cut = AFTER_DURING; duration = postfix { During_limit (on_cut, duration) }
  | AFTER_ASSURE; c = closure { Until_limit (Fails, c) }
  | ENSURE; c = closure { Ensure_limit c }

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

argument_item(limit):
  | e = item(limit) { Positional_item e }

command_argument:
  | a = argument_item(any_limit) { a }
  | k = argument_key; COLON; e = item(any_limit) { Named_item (k, e) }
  | k = computed_key; COLON; e = item(any_limit) { Keyed_item (k, e) }

computed_key:
  | t = template { t }
  | e = parenthesised { e }

argument_key:
  | k = NAME | k = STRING { located $loc k }
  | WILDCARD { located $loc "_" }

(* Expressions *)

expression(limit):
  | e = limited(limit)
    { e }
  | e = rounds(limit)
    { e }
  | target = postfix; by = STEP
    { item (expression $loc (Increment { target; by; prefix = false })) }
  | by = STEP; target = postfix
    { item (expression $loc (Increment { target; by; prefix = true })) }
  | NOT; e = expression(limit)
    { item (expression $loc (Unary (Not, settle e))) }
  | MINUS; e = expression(limit)                                             %prec NOT
    { item (expression $loc (Unary (Negate, settle e))) }
  | PLUS; e = expression(limit)                                              %prec NOT
    { e }
  | a = expression(limit); o = operator; b = expression(limit)
    { item (expression $loc (Binary (o, settle a, settle b))) }
  | first = expression(limit); RANGE; last = expression(limit)
    { item (expression $loc (Range { first = settle first; last = settle last; inclusive = true })) }
  | first = expression(limit); RANGE_LESS; last = expression(limit)
    { item (expression $loc (Range { first = settle first; last = settle last; inclusive = false })) }
  | c = expression(limit); QUESTION; a = expression(any_limit); COLON; b = expression(limit)    %prec QUESTION
    { item (expression $loc (Conditional (settle c, settle a, settle b))) }
  | a = expression(limit); ELVIS; b = expression(limit)
    { item (expression $loc (Elvis (settle a, settle b))) }
  | WHEN; c = closure; THEN; t = item(limit)
    { item (expression $loc (When (c, settle t))) }
  | WAIT_FOR; c = closure; THEN; t = item(limit)
  | WAIT_FOR; c = closure; RUN; t = item(limit)
    { item (expression $loc (Wait_for (c, settle t))) }
  | USING; reversed = command_arguments; RUN; t = item(limit)
    { item (Node.using $loc reversed (settle t)) }
  | on_cut = UNTIL; c = closure; RUN; t = item(limit)
    { item (expression $loc (Until (on_cut, c, settle t))) }
  | on_cut = DURING; d = item(any_limit); RUN; t = item(limit)
    { item (expression $loc (During (on_cut, settle d, settle t))) }
  | REPEAT; t = item(inner_limit)                                            %prec repeated
    { item (expression $loc (Repeat { rounds = None; body = settle t; until = None })) }
  | REPEAT; n = item(inner_limit); COMMA; t = item(inner_limit)              %prec repeated
    { item (expression $loc (Repeat { rounds = Some (settle n); body = settle t; until = None })) }

(* A task and its postfix forms, which bind tighter than all operators. *)
limited(limit):
  | e = postfix
    { item e }
  | WATCH; t = item(any_limit); ON_ERROR; c = closure
    { item (expression $loc (Watch (settle t, c))) }
  | RECRUIT; BLOCK; settings = statements; RBRACE; THEN; c = closure
    { item (expression $loc (Recruit (settings, c))) }
  | e = limited(limit); l = limit
    { Node.limit e l $endpos }

(* A [repeat] with its [until], and limits of all rounds. An operator behind it is not accepted: in [repeat A until {
   C } >> B] readers cannot see the owner of the [until]. NEVER makes that an error. *)
rounds(limit):
  | e = closed_rounds(limit)                                                 %prec whole_expression
    { e }
  | e = closed_rounds(limit); operator; NEVER
    { e }

closed_rounds(limit):
  | REPEAT; t = item(inner_limit); AFTER_UNTIL; c = closure
    { item (expression $loc (Repeat { rounds = None; body = settle t; until = Some c })) }
  | REPEAT; n = item(inner_limit); COMMA; t = item(inner_limit); AFTER_UNTIL; c = closure
    { item (expression $loc (Repeat { rounds = Some (settle n); body = settle t; until = Some c })) }
  | e = closed_rounds(limit); l = limit
    { Node.limit e l $endpos }

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
  | e = item(any_limit) { [ settle e ] }
  | rest = items; COMMA; e = item(any_limit) { settle e :: rest }

entries:
  | e = entry { [ e ] }
  | rest = entries; COMMA; e = entry { e :: rest }

entry:
  | k = key; COLON; e = item(any_limit) { located $loc(k) k, settle e }

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
