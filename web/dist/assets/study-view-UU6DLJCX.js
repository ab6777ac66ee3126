import{j as i}from"./chunk-U7U2WTVZ.js";function t({id:n}){return i("h1",{children:n})}export{t as StudyView};
