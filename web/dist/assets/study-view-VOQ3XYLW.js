import{h as i}from"./chunk-GYUW27G2.js";function t({id:n}){return i("h1",{children:n})}export{t as StudyView};
